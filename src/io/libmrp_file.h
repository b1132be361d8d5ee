// SPDX-License-Identifier: MIT
// Reads and writes instance files of libMultiRobotPlanning
// (https://github.com/whoenig/libMultiRobotPlanning) and of MGCBS
// (https://github.com/tangmingkai/MGCBS), which uses the same YAML with lists of goals:
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
// Cells are [x, y], as in Grove's files. Neither tool specifies the position of the origin. The
// viewer of libMultiRobotPlanning draws y upwards, so it shows Grove's maps upside down; this has
// no other effect.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/input_rules.h"
#include "model/instance.h"

namespace grove::detail {

// Reads both formats. `goal`, or the only entry of `potentialGoals`, is the agent's destination.
// `goals` are the tasks of an agent without a destination; a cell that several agents list is one
// task for all of them. Throws InputError with line and column for invalid files, for more than one
// potential goal (Grove does not assign goals), for roadmaps, and for more than 2^24 cells, which a
// file of a few bytes could request. Appends a warning for each unknown key to `warnings`, unless
// it is nullptr.
Instance read_libmrp_instance(const std::filesystem::path& path,
                              std::vector<std::string>* warnings = nullptr,
                              const InputRules& rules = {});

// Writes a classical MAPF instance for libMultiRobotPlanning, atomically. Throws NotRepresentable
// if the map is a roadmap, there are tasks, an agent has no destination, or its turns take time.
// Throws InputError if the file cannot be written.
void write_libmrp_instance(const std::filesystem::path& path, const Instance& instance);

// Writes a classical MAPF instance for solvers that assign goals (CBS-TA, ITA-CBS), atomically.
// Each agent has a list of potential goals with one entry. Throws the exceptions of
// write_libmrp_instance().
void write_potential_goals(const std::filesystem::path& path, const Instance& instance);

// Writes an MG-MAPF instance for MGCBS, atomically. Throws NotRepresentable if the map is a
// roadmap; an agent has a destination, no tasks, or turns that take time; or the tasks take time,
// share a cell, or do not have the default ids. Throws InputError if the file cannot be written.
void write_mgcbs_instance(const std::filesystem::path& path, const Instance& instance);

}  // namespace grove::detail
