// SPDX-License-Identifier: MIT
// Reachable configurations of the agents of a tiny instance, by exhaustive search.
#pragma once

#include <cstddef>
#include <set>
#include <vector>

#include "model/instance.h"

namespace grove::detail::oracle {

// Configuration: the place of each agent, by agent index.
using Places = std::vector<Place>;

// Returns the configurations that are reachable from the starts by steps without collisions. Turns
// are ignored, as if they took no time. Returns an empty set if there are more than `max_count`
// configurations.
std::set<Places> reachable_configurations(const Instance& instance, std::size_t max_count);

}  // namespace grove::detail::oracle
