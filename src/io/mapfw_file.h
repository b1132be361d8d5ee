// SPDX-License-Identifier: MIT
// Reads and writes problem files of mapfw.nl. MAPFW, multi-agent path finding with waypoints, is
// the same problem as CTS-MAPF.
//
//   {"grid": [[0,0,1], [0,0,0]], "width": 3, "height": 2,
//    "starts": [[0,0]], "goals": [[2,1]], "waypoints": [[[0,1],[1,1]]]}
//
// grid[y][x] is 0 if the cell is passable. Cells are [x, y]. waypoints[i] lists the cells that
// agent i must visit, in any order.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "model/instance.h"

namespace grove::detail {

// Reads a problem, in the format of the member "problem" of a message from mapfw.nl. Agents and
// tasks get the default ids. A cell that several agents list is one task for all of them. Throws
// InputError for invalid files. Appends a warning for each unknown key to `warnings`, unless it is
// nullptr.
Instance read_mapfw_problem(const std::filesystem::path& path,
                            std::vector<std::string>* warnings = nullptr);

// Writes a problem, atomically. Each task becomes a waypoint of each of its agents. Throws
// NotRepresentable if the map is a roadmap; an agent has no destination, or turns that take time;
// the tasks take time, need only some of their agents, or share a cell; or ids are not the default
// ids. Throws InputError if the file cannot be written.
void write_mapfw_problem(const std::filesystem::path& path, const Instance& instance);

}  // namespace grove::detail
