// SPDX-License-Identifier: MIT
// In which order agents are planned one after the other.
#pragma once

#include <span>
#include <vector>

#include "grove/detail/model/instance.h"

namespace grove::detail {

// `order` with those moved forward, no further than needed, that must visit the destination of an
// agent before them: once that agent has come to rest nobody visits it any more. Of agents that
// must visit each other's, in a ring, one comes before its visitor all the same.
std::vector<AgentIndex> visitors_first(const Instance& instance, std::span<const AgentIndex> order);

}  // namespace grove::detail
