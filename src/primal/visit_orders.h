// SPDX-License-Identifier: MIT
// Visit orders: the order in which each agent visits its stops if the other agents are ignored.
#pragma once

#include <optional>
#include <vector>

#include "search/problem.h"
#include "sequencing/sequence.h"

namespace grove::detail {

// A complete sequence per agent, by AgentIndex: its cheapest one, except for the changes by
// separate_ends(). An agent that cannot reach all its stops keeps the order of the instance.
// Returns nullopt if a limit was reached.
std::optional<std::vector<Sequence>> cheapest_orders(const Problem& problem, const Limits& limits);

// Changes complete sequences, by AgentIndex, so that agents without a destination end on different
// stops, and none on another agent's destination, as far as possible. The new last stop of an agent
// is moved to the end of its sequence.
void separate_ends(const Instance& instance, std::vector<Sequence>& orders);

}  // namespace grove::detail
