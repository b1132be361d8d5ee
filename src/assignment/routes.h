// SPDX-License-Identifier: MIT
// The routes of all agents: the order in which each visits its stops, and its destination.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "assignment/route_costs.h"
#include "model/instance.h"
#include "model/omega.h"

namespace grove::detail {

// The task that the agent is executing at its start, which it therefore visits first; nullopt:
// none.
std::optional<TaskIndex> task_at_start(const Instance& instance, AgentIndex agent);

// Cheapest position for a task in a route.
struct Insertion {
  Time cost = kNever;  // increase of the route's cost; kNever: no route visits the task there
  std::size_t position = 0;
};

// The cost of a route is the sum of its legs, plus `visit_weight` times the sum of the times at
// which it reaches its stops, without conflicts between agents. At first all routes are empty.
// Copies are independent. One thread at a time.
class Routes {
 public:
  // `costs` must outlive this object. `visit_weight`: from 0 to 100.
  explicit Routes(const RouteCosts& costs, Cost visit_weight = 0);

  const RouteCosts& costs() const { return *costs_; }
  const std::vector<TaskIndex>& stops(AgentIndex agent) const { return stops_[agent]; }
  std::optional<Place> goal(AgentIndex agent) const { return goals_[agent]; }
  bool visits(AgentIndex agent, TaskIndex task) const;
  // The sum of the costs of all routes.
  Cost cost() const;
  // The cost of one route.
  Cost cost(AgentIndex agent) const;

  Insertion cheapest(AgentIndex agent, TaskIndex task) const {
    return cheapest(agent, task, [] { return true; });
  }
  // Considers the positions for which `consider` returns true.
  template <class Consider>
  Insertion cheapest(AgentIndex agent, TaskIndex task, Consider consider) const;
  void insert(AgentIndex agent, TaskIndex task, std::size_t position);
  void set_stops(AgentIndex agent, std::vector<TaskIndex> stops) {
    stops_[agent] = std::move(stops);
  }
  // Returns by how much the cost of the route falls. Precondition: the agent visits the task.
  Cost remove(AgentIndex agent, TaskIndex task);

  // Chooses the goals of all agents with a choice, so that the legs to the goals cost least, where
  // a random number of steps up to `noise` is added to each. Returns false if there are too few
  // goals.
  bool choose_goals() { return choose_goals(0, 0); }
  bool choose_goals(Time noise, std::uint64_t seed);
  // Sets the goal of an agent with a choice.
  void set_goal(AgentIndex agent, Place goal);
  // The leg to `goal` from the end of the agent's route.
  Time leg_to_goal(AgentIndex agent, Place goal) const;

 private:
  void find_legs_to_rest();
  std::size_t first_position(AgentIndex agent, TaskIndex task) const;
  Time leg(AgentIndex agent, std::size_t at) const;
  Time leg_from(AgentIndex agent, TaskIndex task, std::size_t at) const;
  Time to_rest(AgentIndex agent, TaskIndex from) const;
  // The cost of an insertion at position `at` that is `before` steps from the stop before it, which
  // the agent reaches at time `arrival`, and `after` steps from the next one.
  Time insertion_cost(AgentIndex agent, std::size_t at, Cost arrival, Time before,
                      Time after) const;
  Time start_to_rest(AgentIndex agent) const;

  const RouteCosts* costs_;
  const Instance* instance_;
  Cost visit_weight_;
  std::vector<std::vector<TaskIndex>> stops_;  // by AgentIndex
  std::vector<std::optional<Place>> goals_;
  std::vector<const std::vector<Time>*>
      legs_to_rest_;  // by AgentIndex, then task; nullptr: no goal
  std::vector<bool> starts_at_work_;
};

template <class Consider>
Insertion Routes::cheapest(AgentIndex agent, TaskIndex task, Consider consider) const {
  const std::vector<TaskIndex>& stops = stops_[agent];
  Insertion best;
  if (stops.size() >= kMaxTasksPerAgent || visits(agent, task)) return best;
  Time before = kNever;
  Cost arrival = 0;  // at the stop before
  for (std::size_t at = 0; at <= stops.size(); ++at) {
    before =
        at == 0 ? costs_->from_start(agent, task) : costs_->between(agent, stops[at - 1], task);
    if (at > 0) arrival += leg(agent, at - 1);
    if (at < first_position(agent, task) || !consider()) continue;
    const Time after = leg_from(agent, task, at);
    if (before >= kNever || after >= kNever) continue;
    const Time cost = insertion_cost(agent, at, arrival, before, after);
    if (cost < best.cost) best = {cost, at};
  }
  return best;
}

}  // namespace grove::detail
