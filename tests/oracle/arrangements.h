// SPDX-License-Identifier: MIT
// Reachable configurations of the agents of a tiny instance, by exhaustive search.
#pragma once

#include <cstddef>
#include <set>
#include <vector>

#include "model/instance.h"

namespace grove::detail::oracle {

// Configuration: the place of each agent.
using Places = std::vector<Place>;

// The configurations that are reachable from the starts by steps without collisions. Agents that
// turn are treated as if they turned freely. Empty if there are more than `max_count`.
std::set<Places> reachable_configurations(const Instance& instance, std::size_t max_count);

}  // namespace grove::detail::oracle
