// SPDX-License-Identifier: MIT
// One agent alone in the world: its states, its moves and its exact cost to go.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "grove/model/instance.h"

namespace grove::oracle {

// The states of one agent: (cell, set of visited tasks, has it come to rest for ever), numbered
// from 0. A state in which the agent may come to rest offers, besides its moves, the decision to do
// so: it stays, now and for ever, and no longer costs anything.
class AgentStates {
 public:
  using State = std::int32_t;

  struct Move {
    State to;
    Time cost;
  };

  AgentStates(const Instance& instance, AgentIndex agent);

  State count() const { return static_cast<State>(moves_.size()); }
  // At time 0; a task on the start is visited already.
  State start() const { return start_; }
  const std::vector<Move>& moves(State s) const { return moves_[s]; }
  Place cell(State s) const {
    return passable_[static_cast<std::size_t>(s / 2) % passable_.size()];
  }
  // Which of Agent::tasks are visited, as bits.
  std::uint64_t visited(State s) const {
    return static_cast<std::size_t>(s / 2) / passable_.size();
  }
  bool resting(State s) const { return s % 2 != 0; }
  // Least cost until it can rest, were it alone; 0 exactly where it rests or may. kNever: never.
  Time to_go(State s) const { return to_go_[s]; }

  // Would the numbers above fit for this agent?
  static bool fits(const Instance& instance, AgentIndex agent);

 private:
  State state(std::size_t cell_index, std::uint64_t visited, bool resting) const;
  std::uint64_t visit(std::uint64_t visited, Place cell) const;
  bool may_rest(Place cell, std::uint64_t visited) const;
  void connect(const Map& map);
  void settle_costs();

  std::vector<Place> passable_;
  std::vector<Place> task_cells_;
  std::optional<Place> goal_;
  State start_ = 0;
  std::vector<std::vector<Move>> moves_;
  std::vector<Time> to_go_;
};

}  // namespace grove::oracle
