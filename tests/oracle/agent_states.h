// SPDX-License-Identifier: MIT
// State space of a single agent, ignoring all other agents: states, moves and exact costs-to-go.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "model/instance.h"

namespace grove::detail::oracle {

// State of an agent: its pose, the task in execution, the visited tasks, and whether it has come to
// rest for good. Computed from the instance, without the search code of the library.
struct AgentState {
  Pose pose;
  int work = -1;              // task in execution, as index in tasks(); -1: none
  Time done = 0;              // steps of `work` completed
  std::uint64_t visited = 0;  // bit i: tasks()[i] is visited
  bool resting = false;       // rests forever

  auto key() const {
    return std::tuple(pose.place, pose.heading, pose.to, pose.steps, work, done, visited, resting);
  }
  bool operator<(const AgentState& other) const { return key() < other.key(); }
};

// The reachable states of one agent, numbered from 0. From a state in which the agent may rest, one
// of its moves is to rest there forever at no further cost.
class AgentStates {
 public:
  using State = std::int32_t;

  struct Move {
    State to;
    Time cost;
  };

  // Throws TooMany if there are more than 2^20 states. `instance` must outlive this object.
  AgentStates(const Instance& instance, AgentIndex agent);
  struct TooMany {};

  // The tasks that the agent must visit, and then those that it may visit.
  const std::vector<TaskIndex>& tasks() const { return tasks_; }
  State count() const { return static_cast<State>(states_.size()); }
  // State at time 0, in which a task on the start that takes no time is already visited.
  State start() const { return 0; }
  const std::vector<Move>& moves(State s) const { return moves_[s]; }
  const AgentState& standing(State s) const { return states_[s]; }
  Place cell(State s) const { return states_[s].pose.place; }
  bool resting(State s) const { return states_[s].resting; }
  // Least cost until the agent can rest, ignoring other agents and tasks that it may visit: 0 if and only if it rests or may
  // rest; kNever if it can never rest.
  Time to_go(State s) const { return to_go_[s]; }

 private:
  State number(const AgentState& standing);
  void connect(State s);
  void arrive(AgentState& standing) const;
  bool may_rest(const AgentState& standing) const;
  std::vector<AgentState> next(const AgentState& standing) const;
  void compute_costs_to_go();

  const Instance& instance_;
  const Agent& agent_;
  std::vector<TaskIndex> tasks_;
  std::vector<std::vector<Place>> steps_;  // adjacent places, by place
  std::map<AgentState, State> numbers_;
  std::vector<AgentState> states_;
  std::vector<std::vector<Move>> moves_;
  std::vector<Time> to_go_;
};

}  // namespace grove::detail::oracle
