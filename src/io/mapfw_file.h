// SPDX-License-Identifier: MIT
// Problems of MAPFW, multi-agent path finding with waypoints (mapfw.nl): CTS-MAPF in other words.
//
//   {"grid": [[0,0,1], [0,0,0]], "width": 3, "height": 2,
//    "starts": [[0,0]], "goals": [[2,1]], "waypoints": [[[0,1],[1,1]]]}
//
// grid[y][x] is 0 where the cell is passable; cells are [x, y]; waypoints[i] is what agent i
// visits, in any order.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "model/instance.h"

namespace grove::detail {

// Reads a problem: the "problem" member of what mapfw.nl sends, which is itself a text of JSON. Ids
// are the default ones; a cell that several agents list is one task for all of them. Throws
// InputError on anything malformed. Appends to `warnings` about unknown keys.
Instance read_mapfw_problem(const std::filesystem::path& path,
                            std::vector<std::string>* warnings = nullptr);

// Writes a problem, whole or not at all; a task is a waypoint of each of its agents. Throws
// NotRepresentable for agents without a destination and for ids that are not the default ones,
// InputError when the file cannot be written.
void write_mapfw_problem(const std::filesystem::path& path, const Instance& instance);

}  // namespace grove::detail
