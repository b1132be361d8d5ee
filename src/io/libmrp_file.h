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
// Cells are [x, y] as in Grove's files. Neither tool says where the origin is;
// libMultiRobotPlanning's viewer draws y upwards, which shows the map upside down and changes
// nothing else.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/input_rules.h"
#include "model/instance.h"

namespace grove::detail {

// Reads either. `goal` is a destination, and so is a list `potentialGoals` of one; `goals` are
// tasks of an agent without a destination, and one task for all agents that list the same cell.
// Throws InputError with line and column on anything malformed, on a choice of potentialGoals,
// which is a problem that Grove does not solve, on roadmaps, and on more than 2^24 cells, which a
// few bytes could ask for. Appends to `warnings` about unknown keys.
Instance read_libmrp_instance(const std::filesystem::path& path,
                              std::vector<std::string>* warnings = nullptr,
                              const InputRules& rules = {});

// Writes classical MAPF for libMultiRobotPlanning, whole or not at all. Throws NotRepresentable for
// tasks and for agents without a destination, InputError when the file cannot be written.
void write_libmrp_instance(const std::filesystem::path& path, const Instance& instance);

// The same for solvers that assign goals (CBS-TA, ITA-CBS): each agent has a list of potential
// goals, of one.
void write_potential_goals(const std::filesystem::path& path, const Instance& instance);

// Writes MG-MAPF for MGCBS, whole or not at all. Throws NotRepresentable for agents with a
// destination and ids of tasks that are not the default ones, InputError when the file cannot be
// written.
void write_mgcbs_instance(const std::filesystem::path& path, const Instance& instance);

}  // namespace grove::detail
