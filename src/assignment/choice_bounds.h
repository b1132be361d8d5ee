// SPDX-License-Identifier: MIT
// Lower bounds for instances in which agents choose tasks and goals.
#pragma once

#include "model/distance_field.h"
#include "model/instance.h"
#include "model/limits.h"
#include "model/omega.h"

namespace grove::detail {

// Returns a proven lower bound on the cost of every plan, without conflicts between agents;
// kInfiniteCost: there is no plan. The proof is at the head of choice_bounds.cpp. `distances` must
// be complete. If a limit is reached, the bound can be lower.
Cost lower_bound_of_choices(const Instance& instance, const DistanceFields& distances,
                            const Limits& limits);

}  // namespace grove::detail
