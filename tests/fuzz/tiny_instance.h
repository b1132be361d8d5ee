// SPDX-License-Identifier: MIT
// A tiny instance as plain data that is easy to change, print and parse.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/instance.h"

namespace grove::detail::fuzz {

// Agents and tasks are named by their index: agent 0 is "a0", task 0 is "t0".
//
// Text format ('#' starts a comment, blank lines are ignored):
//
//     map
//     ....
//     .@@.
//     agents
//     0,0 -> 3,1     (start -> destination, as x,y)
//     3,0 -> -       (an MG agent)
//     tasks
//     2,0: 0 1       (cell: the agents that must visit it)
//     2,0 takes 3: 0 (the task takes 3 steps)
//
// After an agent these fields can follow:
//
//     turn 2 N       (a quarter turn takes 2 steps; it faces north)
//     to E 1         (it has made one step of the turn to the east)
//     end S          (it must face south at the end)
//     work 0 2       (it has done 2 steps of task 0)
//     road 1 2       (it starts on road 1 after 2 of its steps, not on the cell)
//
// A line "no following" forbids agents to enter a place in the step in which another agent leaves
// it.
//
// With a section of roads, the passable cells are the vertices of a roadmap, and only the roads
// connect them:
//
//     roads
//     0,0 = 1,0 3    (in 3 steps, both ways)
//     1,0 > 2,0 1    (one way)
struct TinyInstance {
  struct Agent {
    Position start;
    std::optional<Position> goal;
    Time turn_steps = 0;  // steps of a quarter turn; 0: turning takes no time
    Heading heading = Heading::kNorth;
    Heading to = Heading::kNorth;
    Time turned = 0;
    std::optional<Heading> goal_heading = {};
    int work = -1;  // index of a task in execution at the start; -1: none
    Time done = 0;
    int road = -1;
    Time along = 0;
    friend bool operator==(const Agent&, const Agent&) = default;
  };
  struct Task {
    Position cell;
    std::vector<int> agents;
    Time duration = 0;
    friend bool operator==(const Task&, const Task&) = default;
  };

  struct Road {
    Position from;
    Position to;
    Time steps = 1;
    bool one_way = false;
    friend bool operator==(const Road&, const Road&) = default;
  };

  std::vector<std::string> rows;  // '.' passable, '@' blocked
  std::vector<Road> roads;        // empty: a grid
  std::vector<Agent> agents;
  std::vector<Task> tasks;
  bool may_follow = true;

  // Throws InstanceError or std::invalid_argument if the instance is invalid.
  Instance build() const;
  std::string to_text() const;
  // Throws std::invalid_argument with the line number if `text` is malformed.
  static TinyInstance parse(std::string_view text);

  friend bool operator==(const TinyInstance&, const TinyInstance&) = default;
};

// Returns the passable cells, row by row.
std::vector<Position> passable_cells(const std::vector<std::string>& rows);

// Returns whether `p` is a start, a destination or a task cell.
bool in_use(const TinyInstance& instance, Position p);

}  // namespace grove::detail::fuzz
