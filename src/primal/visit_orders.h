// SPDX-License-Identifier: MIT
// In which order each agent is to visit its stops, when others are ignored.
#pragma once

#include <optional>
#include <vector>

#include "search/problem.h"
#include "sequencing/sequence.h"

namespace grove::detail {

// A complete sequence per agent, by AgentIndex: its cheapest one, except for what separate_ends()
// changes. An agent that cannot reach all its stops keeps them in the order of the instance. None
// when a limit struck.
std::optional<std::vector<Sequence>> cheapest_orders(const Problem& problem, const Limits& limits);

// Changes complete sequences, by AgentIndex, so that agents without a destination end on different
// stops, and none on another's destination, where that is possible at all; those that have to end
// elsewhere do so after the stops before it.
void separate_ends(const Instance& instance, std::vector<Sequence>& orders);

}  // namespace grove::detail
