// SPDX-License-Identifier: MIT
// Optimum of a few agents under constraints, by enumeration and comparison of all their paths.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "model/instance.h"
#include "planning/constraint.h"

namespace grove::detail::oracle {

// Path of an agent as places at times 0, 1, ... until it comes to rest. Its cost is its size
// less 1.
using PlacePath = std::vector<Place>;

// The paths of an agent that satisfy `constraints` and cost `most` or less, in ascending order of
// cost. Returns nullopt if there are more than `cap` paths, or more than 40 * `cap` states to
// examine.
std::optional<std::vector<PlacePath>> paths_within(const Instance& instance, AgentIndex agent,
                                                   std::span<const Constraint> constraints,
                                                   Time most, std::size_t cap);

// The least total cost of one path per agent without collisions. `ways`: the paths of each agent.
// Returns nullopt if all combinations collide.
std::optional<Cost> least_joint_cost(const Instance& instance,
                                     std::span<const std::vector<PlacePath>> ways);

}  // namespace grove::detail::oracle
