// SPDX-License-Identifier: MIT
// Choice of destinations for agents without one. It turns an MG-MAPF instance into a CTS-MAPF
// instance by making one task of each such agent its destination (CTS-CBS-B; paper, section V-B).
#pragma once

#include <optional>
#include <vector>

#include "model/limits.h"
#include "model/plan.h"
#include "planning/problem.h"

namespace grove::detail {

inline constexpr TaskIndex kNoTask = -1;

struct Destinations {
  std::vector<TaskIndex> tasks;  // by AgentIndex; kNoTask: the agent already has a destination
  // The sum of the agents' best sequence costs. Proven: no plan of the instance costs less,
  // wherever the agents end.
  Cost bound = 0;
};

// Chooses, for each agent without a destination, one of its tasks as its destination. The chosen
// tasks are distinct, and none is at the destination of another agent. The choice minimises the sum
// of the costs of the agents' best sequences that end on the chosen tasks, plus `visitor_steps`
// time steps for each other agent that must visit a chosen task. The method is at the head of
// destinations.cpp. Returns nullopt if a limit was reached or if no such choice exists.
std::optional<Destinations> choose_destinations(const Problem& problem, Cost visitor_steps,
                                                const Limits& limits);

// Returns the instance in which the place of each chosen task is the agent's destination, and the
// agent no longer has the task.
Instance with_destinations(const Instance& instance, const Destinations& destinations);

// Converts a plan of with_destinations(instance, destinations) to a plan of `instance`. The paths
// stay the same; the chosen task is appended to the agent's sequence.
Plan without_destinations(const Instance& instance, const Destinations& destinations, Plan plan);

}  // namespace grove::detail
