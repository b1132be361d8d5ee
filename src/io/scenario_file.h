// SPDX-License-Identifier: MIT
// Reads and writes Moving AI scenarios (.scen).
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "io/input_rules.h"
#include "model/grid.h"

namespace grove::detail {

// A row of a scenario, without bucket and length. (The length in Moving AI's files is an octile
// distance, not the distance in a 4-connected grid.)
struct ScenarioRow {
  int line = 0;  // line in the file, from 1; for messages
  std::string map;
  int width = 0;
  int height = 0;
  Position start;
  Position goal;
};

// Reads all rows, in the order of the file. Throws InputError, with line and column, for invalid
// content.
std::vector<ScenarioRow> read_scenario(const std::filesystem::path& path);

// Returns the path of the map that the first row names, in the folder of `scenario`. Returns an
// empty path if there is no row or no such file. Throws InputError if the scenario is invalid or
// `rules` forbid the map.
std::filesystem::path map_beside(const std::filesystem::path& scenario,
                                 const InputRules& rules = {});

// Throws InputError, with the line in `scenario`, unless every row has the file name of `map`
// (without its folder) and the size of `grid`.
void require_same_map(const std::filesystem::path& scenario, std::span<const ScenarioRow> rows,
                      const std::filesystem::path& map, const Grid& grid);

// Writes a scenario, atomically. `lengths` has one entry per row for the last column, which is the
// 4-connected distance from start to goal (Moving AI's own files have the octile distance). The
// bucket is a quarter of the length, as in Moving AI's files.
void write_scenario(const std::filesystem::path& path, const std::vector<ScenarioRow>& rows,
                    const std::vector<Time>& lengths);

}  // namespace grove::detail
