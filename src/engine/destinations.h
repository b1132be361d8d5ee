// SPDX-License-Identifier: MIT
// Choice of destinations for agents without one. Making one task of each such agent its destination
// turns an MG-MAPF instance into a CTS-MAPF instance (CTS-CBS-B; paper, section V-B).
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
  // Proven: no plan of the instance costs less, wherever the agents end. It is the sum of the
  // agents' best sequence costs.
  Cost bound = 0;
};

// Chooses distinct destinations: each is a task of its agent and no other agent's destination. The
// choice minimises the sum of the agents' best sequence costs with these ends, plus `visitor_steps`
// for each other agent that must visit such a task. The method is at the head of destinations.cpp.
// Returns nullopt if a limit was reached or if there is no such choice.
std::optional<Destinations> choose_destinations(const Problem& problem, Cost visitor_steps,
                                                const Limits& limits);

// Returns the instance in which the chosen tasks are destinations, and no longer tasks of their
// agents.
Instance with_destinations(const Instance& instance, const Destinations& destinations);

// Converts a plan of with_destinations(instance, destinations) to a plan of `instance`: the same
// paths, with the destination appended to the sequence as the last task.
Plan without_destinations(const Instance& instance, const Destinations& destinations, Plan plan);

}  // namespace grove::detail
