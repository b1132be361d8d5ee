// SPDX-License-Identifier: MIT
// Moving AI scenarios (.scen), read strictly.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "io/input_rules.h"
#include "model/grid.h"

namespace grove::detail {

// One row. The bucket is not kept, nor the length: an octile distance bounds nothing on a
// 4-connected grid.
struct ScenarioRow {
  int line = 0;  // in the file, from 1: for messages
  std::string map;
  int width = 0;
  int height = 0;
  Position start;
  Position goal;
};

// All rows in file order. Throws InputError with line and column.
std::vector<ScenarioRow> read_scenario(const std::filesystem::path& path);

// The map that the first row names, in the folder of `scenario`; empty if there is no such file.
std::filesystem::path map_beside(const std::filesystem::path& scenario,
                                 const InputRules& rules = {});

// Throws InputError, naming `scenario` and the line, unless every row is for `map`: the file part
// of the name and the size must agree.
void require_same_map(const std::filesystem::path& scenario, std::span<const ScenarioRow> rows,
                      const std::filesystem::path& map, const Grid& grid);

// Writes `rows`, whole or not at all. `lengths`, one per row, fill the last column: the 4-connected
// distance from start to goal, where Moving AI's own files give the octile one. The bucket is a
// quarter of it, as theirs.
void write_scenario(const std::filesystem::path& path, const std::vector<ScenarioRow>& rows,
                    const std::vector<Time>& lengths);

}  // namespace grove::detail
