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
//                               # CBS-TA, ITA-CBS: potentialGoals, a list: to end on one of them
//
// Cells are [x, y], as in Grove's files. Neither tool specifies the position of the origin. The
// viewer of libMultiRobotPlanning draws y upwards, so it shows Grove's maps upside down; this has
// no other effect.
//
// In files of ITA-CBS (https://github.com/TachikakaMin/ITA-CBS2) `map` can be the name of a Moving
// AI map, relative to the file. Cells are then [row, column].
//
// An agent with an empty list of potential goals may end anywhere. If all potential goals are taken
// by other agents, CBS-TA also lets an agent with a list end anywhere. Grove requires that each
// agent with a list ends on a cell of its own list.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/input_rules.h"
#include "model/instance.h"

namespace grove::detail {

// Reads all these formats. `goal`, or the only cell of `potentialGoals`, is the agent's
// destination. From several potential goals the agent chooses; a cell that is listed twice counts
// once. `goals` are the tasks of an agent without a destination; a cell that several agents list is
// one task for all of them. Throws InputError with line and column for invalid files, for roadmaps,
// and for more than 2^24 cells, which a file of a few bytes could request. Appends a warning for
// each unknown key, and those of read_map(), to `warnings`, unless it is nullptr.
Instance read_libmrp_instance(const std::filesystem::path& path,
                              std::vector<std::string>* warnings = nullptr,
                              const InputRules& rules = {});

// Writes a classical MAPF instance for libMultiRobotPlanning, atomically. Throws NotRepresentable
// if the map is a roadmap, there are tasks, an agent has no destination or a choice, or its turns
// take time.
// Throws InputError if the file cannot be written.
void write_libmrp_instance(const std::filesystem::path& path, const Instance& instance);

// Writes an instance for solvers that assign goals (CBS-TA, ITA-CBS), atomically. Each agent has a
// list of potential goals; that of an agent with a fixed destination has one entry, and that of an
// agent without a destination is empty. Throws NotRepresentable if the map is a roadmap, there are
// tasks, or turns of an agent take time. Throws InputError if the file cannot be written.
void write_potential_goals(const std::filesystem::path& path, const Instance& instance);

// Writes an MG-MAPF instance for MGCBS, atomically. Throws NotRepresentable if the map is a
// roadmap; an agent has a destination, no tasks, or turns that take time; or the tasks take time,
// need only some of their agents, share a cell, or do not have the default ids. Throws InputError
// if the file cannot be written.
void write_mgcbs_instance(const std::filesystem::path& path, const Instance& instance);

}  // namespace grove::detail
