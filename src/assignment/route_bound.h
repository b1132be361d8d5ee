// SPDX-License-Identifier: MIT
// Lagrangian lower bound on the routes of agents that choose tasks and destinations.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "assignment/routes.h"
#include "model/instance.h"
#include "model/limits.h"
#include "model/omega.h"

namespace grove::detail {

// A lower bound on the cost of every plan, without conflicts between agents. It relaxes how often
// tasks are visited and goals are used, and which visits an agent repeats (ng-routes: Baldacci,
// Mingozzi and Roberti 2011). If there are too many agents and tasks, it has no bound. The proof is
// at the head of route_bound.cpp. Repeatable, unless a limit is reached. One thread at a time.
class RouteBound {
 public:
  // `routes`: good routes, which determine the first multipliers. Their RouteCosts must outlive
  // this object.
  explicit RouteBound(const Routes& routes);
  ~RouteBound();

  // Improves the multipliers by subgradient steps, until the bound reaches the cost of the routes,
  // or about `max_effort` labels (model/effort.h) are done, or a limit is reached.
  void improve(std::int64_t max_effort, const Limits& limits);
  // False if a further call of improve() would do nothing.
  bool can_improve() const;

  // The greatest bound so far; 0 before the first step.
  Cost lower_bound() const;

  // The choices that an agent may make in a plan that costs less than `cutoff`, by AgentIndex. The
  // others are proven to cost at least that much (reduced cost fixing). Returns nullopt if there is
  // no bound yet, or if a limit is reached.
  struct Choices {
    std::vector<TaskIndex> visits;  // of Agent::options, in ascending order
    std::vector<Place> goals;       // of Agent::goals
  };
  std::optional<std::vector<Choices>> choices_below(Cost cutoff, const Limits& limits);

  // Integral multipliers, in steps, with a good bound, found by local search from the best
  // multipliers with about `max_effort` labels. Returns nullopt if there is no bound yet, or if it
  // finds none, or if a limit is reached.
  struct Multipliers {
    std::vector<Time> on_visits;                   // by task; 0 for tasks without a choice
    std::vector<std::pair<Place, Time>> on_goals;  // by possible destination
  };
  std::optional<Multipliers> rounded(std::int64_t max_effort, const Limits& limits);

  // The neighbourhood of `task` in the walks of the agent (ng_walks.h), with `task` itself. Walks
  // with these neighbourhoods seldom have cycles of negative cost under rounded() multipliers.
  std::vector<TaskIndex> neighborhood(AgentIndex agent, TaskIndex task) const;

 private:
  class Relaxation;
  std::unique_ptr<Relaxation> relaxation_;
};

}  // namespace grove::detail
