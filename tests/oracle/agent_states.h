// SPDX-License-Identifier: MIT
// One agent alone in the world: its states, its moves and its exact cost to go.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "model/instance.h"

namespace grove::detail::oracle {

// Where an agent is and what it is doing there, said from the instance alone.
struct Standing {
  Pose pose;
  int work = -1;              // the task it is at work on, as position in Agent::tasks; -1: none
  Time done = 0;              // steps of that
  std::uint64_t visited = 0;  // of Agent::tasks, as bits
  bool resting = false;       // for ever

  auto key() const {
    return std::tuple(pose.place, pose.heading, pose.to, pose.steps, work, done, visited, resting);
  }
  bool operator<(const Standing& other) const { return key() < other.key(); }
};

// The states that one agent can come to, numbered from 0. A state in which the agent may come to
// rest offers, besides its moves, the decision to do so: it stays, now and for ever, and no longer
// costs anything.
class AgentStates {
 public:
  using State = std::int32_t;

  struct Move {
    State to;
    Time cost;
  };

  // Throws TooMany if there are more than kMaxStates.
  AgentStates(const Instance& instance, AgentIndex agent);
  struct TooMany {};

  State count() const { return static_cast<State>(states_.size()); }
  // At time 0; a task on the start that takes no time is visited already.
  State start() const { return 0; }
  const std::vector<Move>& moves(State s) const { return moves_[s]; }
  const Standing& standing(State s) const { return states_[s]; }
  Place cell(State s) const { return states_[s].pose.place; }
  bool resting(State s) const { return states_[s].resting; }
  // Least cost until it can rest, were it alone; 0 exactly where it rests or may. kNever: never.
  Time to_go(State s) const { return to_go_[s]; }

 private:
  State number(const Standing& standing);
  void connect(State s);
  void arrive(Standing& standing) const;
  bool may_rest(const Standing& standing) const;
  std::vector<Standing> next(const Standing& standing) const;
  void settle_costs();

  const Instance& instance_;
  const Agent& agent_;
  std::vector<std::vector<Place>> steps_;  // by place
  std::map<Standing, State> numbers_;
  std::vector<Standing> states_;
  std::vector<std::vector<Move>> moves_;
  std::vector<Time> to_go_;
};

}  // namespace grove::detail::oracle
