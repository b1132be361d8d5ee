// SPDX-License-Identifier: MIT
// Instances in which agents pay for their choices.
#pragma once

#include <optional>
#include <vector>

#include "assignment/route_bound.h"
#include "model/instance.h"
#include "model/limits.h"
#include "model/omega.h"
#include "model/plan.h"
#include "planning/agent_prices.h"

namespace grove::detail {

// An instance whose agents have the optional tasks, and the goals, that they may need in a plan
// below some cost. In `instance` each of them must visit the tasks; `prices` states which it may
// leave out. Its plans, with the paths of their agents, are plans of the original instance. The
// proof is at the head of priced_instance.cpp.
struct PricedInstance {
  Instance instance;  // with the agents and tasks of the original instance, at the same indices
  Prices prices;
};

// Returns false if no choices of the instance can be priced, because an agent with a choice needs
// time to turn, or starts while it executes an optional task.
bool can_price_choices(const Instance& instance);

// Returns nullopt if it is not possible: can_price_choices() is false; or an agent with a choice
// needs more than kMaxTasksPerAgent tasks or several tasks on one place, or must visit tasks, some
// of which take time, without a destination; or `bound` has no result; or a limit is reached.
// `cutoff`: plans of this cost or more are left out. The lower it is, the fewer tasks agents need.
std::optional<PricedInstance> price_choices(const Instance& instance, RouteBound& bound,
                                            Cost cutoff, const Limits& limits);

// Makes a plan of `instance` of paths in `priced.instance`. Precondition: the paths have no
// conflicts, count the tasks as often as needed, and end where they may.
Plan plan_of(const Instance& instance, const PricedInstance& priced,
             const std::vector<CountedPath>& paths);

}  // namespace grove::detail
