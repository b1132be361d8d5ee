// SPDX-License-Identifier: MIT
// Heuristic for assignments of low cost, without a bound.
#pragma once

#include <cstdint>
#include <optional>

#include "assignment/assignment.h"
#include "model/distance_field.h"
#include "model/instance.h"
#include "model/limits.h"

namespace grove::detail {

// Returns a complete assignment by regret insertion (Potvin and Rousseau 1993) into the agents'
// routes, without conflicts between agents, followed by large neighbourhood search
// (assignment_lns.h) and another choice of goals. Returns nullopt if it finds none, which proves
// nothing, or if a limit was reached. `distances` must be complete.
std::optional<Assignment> assignment_by_insertion(const Instance& instance,
                                                  const DistanceFields& distances,
                                                  std::uint64_t seed, const Limits& limits);

}  // namespace grove::detail
