// SPDX-License-Identifier: MIT
// Instances of libMultiRobotPlanning (https://github.com/whoenig/libMultiRobotPlanning) and of
// MGCBS (https://github.com/tangmingkai/MGCBS), which reads the same YAML with lists of goals:
//
//   map:
//     dimensions: [5, 2]        # columns, rows
//     obstacles:
//       - [0, 1]
//   agents:
//     - name: agent0
//       start: [0, 0]
//       goal: [4, 0]            # MGCBS: goals, a list: all to be visited in any order
//
// Cells are [x, y] as in Grove's files. Neither tool specifies where the origin is. The viewer of
// libMultiRobotPlanning draws y upwards, so it shows the map upside down; this has no other effect.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/input_rules.h"
#include "model/instance.h"

namespace grove::detail {

// Reads either format. `goal`, or a list `potentialGoals` with one entry, is a destination. `goals`
// are tasks of an agent without a destination; a cell that several agents list is one task for all
// of them. Throws InputError with line and column for invalid files, for several potentialGoals
// (Grove does not solve this problem), for roadmaps, and for more than 2^24 cells, which a file of
// a few bytes could request. Appends a warning for each unknown key to `warnings`.
Instance read_libmrp_instance(const std::filesystem::path& path,
                              std::vector<std::string>* warnings = nullptr,
                              const InputRules& rules = {});

// Writes classical MAPF for libMultiRobotPlanning, atomically. Throws NotRepresentable for tasks
// and for agents without a destination, InputError if the file cannot be written.
void write_libmrp_instance(const std::filesystem::path& path, const Instance& instance);

// The same for solvers that assign goals (CBS-TA, ITA-CBS): each agent has a list of potential
// goals, with one entry.
void write_potential_goals(const std::filesystem::path& path, const Instance& instance);

// Writes MG-MAPF for MGCBS, atomically. Throws NotRepresentable for agents with a destination and
// for ids of tasks that are not the default ones, InputError if the file cannot be written.
void write_mgcbs_instance(const std::filesystem::path& path, const Instance& instance);

}  // namespace grove::detail
