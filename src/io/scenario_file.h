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

// One row. The bucket and the length are not stored, because an octile distance is not a bound on a
// 4-connected grid.
struct ScenarioRow {
  int line = 0;  // in the file, from 1; for messages
  std::string map;
  int width = 0;
  int height = 0;
  Position start;
  Position goal;
};

// All rows in the order of the file. Throws InputError with line and column.
std::vector<ScenarioRow> read_scenario(const std::filesystem::path& path);

// The path of the map that the first row names, in the folder of `scenario`; empty if the file does
// not exist.
std::filesystem::path map_beside(const std::filesystem::path& scenario,
                                 const InputRules& rules = {});

// Throws InputError, with `scenario` and the line, unless every row is for `map`: the file part of
// its name and the size must agree.
void require_same_map(const std::filesystem::path& scenario, std::span<const ScenarioRow> rows,
                      const std::filesystem::path& map, const Grid& grid);

// Writes `rows` atomically. `lengths`, one per row, are written to the last column: the 4-connected
// distance from start to goal, where Moving AI's own files have the octile distance. The bucket is
// a quarter of it, as in Moving AI's files.
void write_scenario(const std::filesystem::path& path, const std::vector<ScenarioRow>& rows,
                    const std::vector<Time>& lengths);

}  // namespace grove::detail
