// SPDX-License-Identifier: MIT
// Where agents without a destination might end: one of each one's tasks made its destination turns
// an MG-MAPF instance into a CTS-MAPF one (CTS-CBS-B; paper, section V-B).
#pragma once

#include <optional>
#include <vector>

#include "model/limits.h"
#include "model/plan.h"
#include "search/problem.h"

namespace grove::detail {

inline constexpr TaskIndex kNoTask = -1;

struct Destinations {
  std::vector<TaskIndex> tasks;  // by AgentIndex; kNoTask: the agent has a destination of its own
  // Proven: no plan of the instance costs less, wherever the agents end: the sum of their best
  // sequences' costs.
  Cost bound = 0;
};

// Distinct ones, each among its agent's tasks and no other's destination, such that the agents'
// best sequences that end there, and `visitor_steps` for every other agent that must visit one, are
// least in sum; how that is found is at the head of destinations.cpp. None if a limit struck or
// there is no such choice.
std::optional<Destinations> choose_destinations(const Problem& problem, Cost visitor_steps,
                                                const Limits& limits);

// The instance in which they are destinations, and no longer tasks of these agents.
Instance with_destinations(const Instance& instance, const Destinations& destinations);

// What a plan of with_destinations(instance, destinations) is for `instance`: the same paths, with
// the last task visited at the end.
Plan without_destinations(const Instance& instance, const Destinations& destinations, Plan plan);

}  // namespace grove::detail
