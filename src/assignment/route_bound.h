// SPDX-License-Identifier: MIT
// Lagrangian lower bound on the routes of agents that choose tasks and destinations.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "assignment/route_choices.h"
#include "assignment/routes.h"
#include "model/instance.h"
#include "model/limits.h"
#include "model/omega.h"

namespace grove::detail {

// A lower bound on the cost of every plan, without conflicts between agents. It relaxes how often
// tasks are visited and goals are used, and which visits an agent repeats (ng-routes: Baldacci,
// Mingozzi and Roberti 2011); the proof is at the head of route_relaxation.cpp. If there are too
// many agents and tasks, it has no bound. Repeatable, unless a limit is reached. Copies are
// independent, but only one of them may be used at a time. One thread at a time.
class RouteBound {
 public:
  using Choices = RouteChoices;

  // `routes`: good routes, which determine the first multipliers. Their RouteCosts must outlive
  // this object and its copies.
  explicit RouteBound(const Routes& routes);
  RouteBound(const RouteBound& other);
  RouteBound& operator=(const RouteBound&) = delete;
  ~RouteBound();

  // Improves the multipliers by subgradient iterations, until the bound reaches the cost of the
  // routes or the cutoff of the last fix(), or the step size is too small, or about `max_effort`
  // legs are scanned (NgWalks::effort()), or a limit is reached.
  void improve(std::int64_t max_effort, const Limits& limits);
  // False if a further call of improve() would do nothing.
  bool can_improve() const;

  // The greatest bound so far; 0 before the first iteration. After fix() and decisions it holds for
  // the plans that they leave.
  Cost lower_bound() const;
  // The same in 1 / AgentWalks::kUnit steps, before it is rounded up.
  std::int64_t fine_bound() const;

  // The choices that an agent may make in a plan that costs less than `cutoff`, by AgentIndex.
  // Every plan that makes another choice costs at least `cutoff` (reduced cost fixing). Returns
  // nullopt if there is no bound yet, or if a limit is reached.
  std::optional<std::vector<Choices>> choices_below(Cost cutoff, const Limits& limits);

  // Leaves the plans that cost less than `cutoff`: removes the choices and the legs of others.
  // Returns false where choices_below() returns nullopt. Precondition: `cutoff` is at most that of
  // the last call.
  bool fix(Cost cutoff, const Limits& limits);
  // Leaves only `choices`, by AgentIndex, and decides the choices that follow. Precondition: after
  // fix().
  void restrict_to(const std::vector<Choices>& choices);
  // The choices that are left, by AgentIndex. is_feasible(): false if no plan makes them.
  const std::vector<Choices>& choices() const;
  bool is_feasible() const;
  // The share of recent walks of the agent that visit the task, or end on the goal.
  double share(AgentIndex agent, TaskIndex task) const;
  double share_of_goal(AgentIndex agent, Place goal) const;

  // Integral multipliers, in steps, with a good bound, found by local search from the best
  // multipliers with about `max_effort` scanned legs. Returns nullopt if there is no bound yet, or
  // if it finds none, or if a limit is reached.
  struct Multipliers {
    std::vector<Time> on_visits;                   // by task; 0 for tasks without a choice
    std::vector<std::pair<Place, Time>> on_goals;  // by possible destination
  };
  std::optional<Multipliers> rounded(std::int64_t max_effort, const Limits& limits);

  // The neighbourhood of `task` in the walks of the agent (ng_walks.h), with `task` itself. Walks
  // with these neighbourhoods seldom have cycles of negative cost under rounded() multipliers.
  std::vector<TaskIndex> neighborhood(AgentIndex agent, TaskIndex task) const;

  std::size_t bytes() const;  // of its largest parts
  // The number of legs that the last full evaluation of multipliers has scanned; 0: none.
  std::int64_t evaluation_effort() const;
  // The number of legs that all copies have scanned.
  std::int64_t effort() const;

 private:
  class Ascent;
  std::unique_ptr<Ascent> ascent_;
};

}  // namespace grove::detail
