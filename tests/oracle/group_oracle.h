// SPDX-License-Identifier: MIT
// Optimum of a few agents under constraints, found by enumerating all their paths and combining
// them.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "model/instance.h"
#include "planning/constraint.h"

namespace grove::detail::oracle {

// Path of an agent: its places at times 0, 1, ... until it comes to rest. Its cost is its size
// minus 1.
using PlacePath = std::vector<Place>;

// Returns all paths of an agent that satisfy `constraints` and cost at most `most`, in ascending
// order of cost. Returns nullopt if there are more than `cap` paths, if the enumeration examines
// more than 40 * `cap` states, or if the agent has too many states for AgentStates.
std::optional<std::vector<PlacePath>> paths_within(const Instance& instance, AgentIndex agent,
                                                   std::span<const Constraint> constraints,
                                                   Time most, std::size_t cap);

// Returns the least total cost of a collision-free combination of one path per agent. `paths`: the
// paths of each agent, in ascending order of cost. Returns nullopt if every combination has a
// collision.
std::optional<Cost> least_joint_cost(const Instance& instance,
                                     std::span<const std::vector<PlacePath>> paths);

}  // namespace grove::detail::oracle
