// SPDX-License-Identifier: MIT
// Lower bounds and proofs of infeasibility for instances in which agents choose tasks and goals.
#pragma once

#include <optional>
#include <string>

#include "model/distance_field.h"
#include "model/instance.h"
#include "model/limits.h"
#include "model/omega.h"

namespace grove::detail {

// The reason why no plan exists, as a sentence, if too few agents of a task can reach it, or if
// agents have fewer goals than they are (Hall 1935). Returns nullopt if neither is the case.
// `distances` must be complete.
std::optional<std::string> infeasible_choices(const Instance& instance,
                                              const DistanceFields& distances);

// Returns a proven lower bound on the cost of every plan, without conflicts between agents. The
// proof is at the head of choice_bounds.cpp. `distances` must be complete. If a limit is reached,
// the bound can be lower.
Cost lower_bound_of_choices(const Instance& instance, const DistanceFields& distances,
                            const Limits& limits);

}  // namespace grove::detail
