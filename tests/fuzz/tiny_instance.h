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

  std::vector<std::string> rows;  // '.' passable, '@' blocked
  std::vector<Agent> agents;
  std::vector<Task> tasks;

  // Throws InstanceError or std::invalid_argument where it breaks the rules.
  Instance build() const;
  std::string to_text() const;
  // Throws std::invalid_argument naming the line.
  static TinyInstance parse(std::string_view text);

  friend bool operator==(const TinyInstance&, const TinyInstance&) = default;
};

// Is some agent's start, destination or task on `p`?
bool in_use(const TinyInstance& instance, Position p);

}  // namespace grove::fuzz
