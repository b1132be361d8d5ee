// SPDX-License-Identifier: MIT
// The walks of one agent through the tasks that it must or may visit (sequencing/ng_walks.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "assignment/route_costs.h"
#include "model/instance.h"
#include "sequencing/ng_walks.h"

namespace grove::detail {

// The tasks of an agent and the legs between them. Walks always remember the first
// NgStops::remembered tasks, which the agent must visit.
struct AgentWalks {
  // Unit of the costs of legs: 1 / kUnit steps.
  static constexpr std::int64_t kUnit = 256;

  AgentIndex agent;
  std::vector<TaskIndex> tasks;  // by stop of `forward`
  NgStops forward;
  std::vector<Place> goals;                 // its possible destinations; empty: it ends anywhere
  std::vector<Time> start_to_goals;         // by position in `goals`; kNever: no path
  std::vector<std::vector<Time>> to_goals;  // by task and position in `goals`
  bool has_all_legs = true;                 // false after keep_legs()

  // Enlarges neighbourhoods along `cycle` (dynamic ng-route relaxation). Returns false if none has
  // changed.
  bool forbid_cycle(const RouteCosts& costs, const std::vector<std::int32_t>& cycle);
  // Keeps the legs for which keep(from, to, cost) is true; from the start: from = -1. They have no
  // further conditions.
  void keep_legs(const RouteCosts& costs,
                 const std::function<bool(std::int32_t, std::int32_t, std::int64_t)>& keep);
  // Removes a stop or a goal. Precondition of the first: after keep_legs().
  void exclude(std::int32_t stop);
  void exclude_goal(Place goal);
  std::size_t bytes() const;  // of its largest parts
  // The walks in reverse direction. first_costs: by stop, the cost from the stop to the end. Before
  // keep_legs() all legs are possible, because a leg that forward walks leave out can be part of a
  // reverse walk.
  NgStops reversed(const RouteCosts& costs, const std::vector<std::int64_t>& first_costs) const;

 private:
  std::vector<NgStops::Leg> legs_from(const RouteCosts& costs, std::int32_t from) const;
};

// Legs that are not needed are left out; the proof is at the head of agent_walks.cpp. `neighbors`:
// the initial and the greatest number of neighbours of a stop.
AgentWalks make_agent_walks(const RouteCosts& costs, AgentIndex agent,
                            std::pair<int, int> neighbors);

}  // namespace grove::detail
