// SPDX-License-Identifier: MIT
// Moving AI scenarios (.scen), read strictly.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "grove/model/grid.h"

namespace grove {

// One row. The length column (octile distance) is not kept: it is no bound for 4-connected grids.
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

// Writes rows (bucket 0, length 0 is never written: the 4-connected distance stands there as given
// in `lengths`, one per row), whole or not at all.
void write_scenario(const std::filesystem::path& path, const std::vector<ScenarioRow>& rows,
                    const std::vector<Time>& lengths);

}  // namespace grove
