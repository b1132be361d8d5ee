// SPDX-License-Identifier: MIT
// The destinations that agents may have, and the choice of the cheapest ones.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "model/instance.h"
#include "model/omega.h"

namespace grove::detail {

// The possible destinations of all agents that `include` selects, distinct, in ascending order.
std::vector<Place> all_destinations(const Instance& instance,
                                    const std::function<bool(const Agent&)>& include);
std::vector<Place> all_destinations(const Instance& instance);

// A choice of distinct destinations, and the sum of its costs.
struct ChosenGoals {
  std::vector<std::optional<Place>> goals;  // by AgentIndex; nullopt: no destination
  Cost cost = 0;
  std::vector<Cost> prices;  // by index in all_destinations(); see MinCostAssignment
};

// Returns a choice of least cost (an assignment problem), or nullopt if none exists.
// cost(agent, place), for each of the agent's destinations: at least 0; kNever or more is allowed
// and means a very expensive destination; nullopt: not allowed.
std::optional<ChosenGoals> cheapest_goals(
    const Instance& instance, const std::function<std::optional<Cost>(AgentIndex, Place)>& cost);

}  // namespace grove::detail
