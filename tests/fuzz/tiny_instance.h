// SPDX-License-Identifier: MIT
// A tiny instance as one writes it down: easy to change, to print and to read back.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "grove/model/instance.h"

namespace grove::fuzz {

// Agents and tasks are named by their positions: agent 0 is "a0", task 0 is "t0".
//
// As text ('#' begins a comment, blank lines do not count):
//
//     map
//     ....
//     .@@.
//     agents
//     0,0 -> 3,1     (start -> destination, as x,y)
//     3,0 -> -       (an MG agent)
//     tasks
//     2,0: 0 1       (cell: the agents that must visit it)
//
// With roads the passable cells are the vertices of a roadmap, and nothing else joins them:
//
//     roads
//     0,0 = 1,0 3    (in 3 steps, both ways)
//     1,0 > 2,0 1    (one way)
struct TinyInstance {
  struct Agent {
    Position start;
    std::optional<Position> goal;
    friend bool operator==(const Agent&, const Agent&) = default;
  };
  struct Task {
    Position cell;
    std::vector<int> agents;
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

  // Throws InstanceError or std::invalid_argument where it breaks the rules.
  Instance build() const;
  std::string to_text() const;
  // Throws std::invalid_argument naming the line.
  static TinyInstance parse(std::string_view text);

  friend bool operator==(const TinyInstance&, const TinyInstance&) = default;
};

// The passable cells, row by row.
std::vector<Position> passable_cells(const std::vector<std::string>& rows);

// Is some agent's start, destination or task on `p`?
bool in_use(const TinyInstance& instance, Position p);

}  // namespace grove::fuzz
