// SPDX-License-Identifier: MIT
// Problems of MAPFW, multi-agent path finding with waypoints (mapfw.nl), which is the same problem
// as CTS-MAPF.
//
//   {"grid": [[0,0,1], [0,0,0]], "width": 3, "height": 2,
//    "starts": [[0,0]], "goals": [[2,1]], "waypoints": [[[0,1],[1,1]]]}
//
// grid[y][x] is 0 if the cell is passable. Cells are [x, y]. waypoints[i] are the cells that agent
// i visits, in any order.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "model/instance.h"

namespace grove::detail {

// Reads a problem: the "problem" member of a message of mapfw.nl, which is itself JSON text. The
// ids are the default ones. A cell that several agents list is one task for all of them. Throws
// InputError for invalid files. Appends a warning for each unknown key to `warnings`.
Instance read_mapfw_problem(const std::filesystem::path& path,
                            std::vector<std::string>* warnings = nullptr);

// Writes a problem, atomically. A task is a waypoint of each of its agents. Throws NotRepresentable
// for agents without a destination and for ids that are not the default ones, InputError if the
// file cannot be written.
void write_mapfw_problem(const std::filesystem::path& path, const Instance& instance);

}  // namespace grove::detail
