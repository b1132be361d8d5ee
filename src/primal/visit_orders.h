// SPDX-License-Identifier: MIT
// Visit orders: orders in which the agents visit their stops, chosen without regard to conflicts.
#pragma once

#include <optional>
#include <vector>

#include "planning/problem.h"
#include "sequencing/sequence.h"

namespace grove::detail {

// Returns a complete sequence per agent, by AgentIndex: the agent's cheapest one, changed by
// separate_ends(). An agent that cannot visit all its stops gets the order of the instance. Returns
// nullopt if a limit was reached.
std::optional<std::vector<Sequence>> cheapest_orders(const Problem& problem, const Limits& limits);

// Changes the complete sequences in `orders`, by AgentIndex, so that agents without a destination
// end on distinct stops, and not on another agent's destination, as far as possible. To change the
// last stop of an agent, moves the new last stop to the end of its sequence.
void separate_ends(const Instance& instance, std::vector<Sequence>& orders);

}  // namespace grove::detail
