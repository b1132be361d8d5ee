// SPDX-License-Identifier: MIT
// The truth about a few agents under demands: all their paths, listed and compared.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "model/instance.h"
#include "planning/constraint.h"

namespace grove::detail::oracle {

// Where an agent is at each time until it comes to rest; so many steps, less one, it costs.
using Way = std::vector<Place>;

// The ways of an agent, alone, that obey these demands and cost `most` or less, the cheapest first.
// None: there are more than `cap`, or more than many times that to look at.
std::optional<std::vector<Way>> ways_within(const Instance& instance, AgentIndex agent,
                                            std::span<const Constraint> demands, Time most,
                                            std::size_t cap);

// The least that one way of each costs together, if they do not collide. None: all do.
std::optional<Cost> least_together(const Instance& instance,
                                   std::span<const std::vector<Way>> ways);

}  // namespace grove::detail::oracle
