// SPDX-License-Identifier: MIT
// Is what a search believes of its nodes and tables true? Slow: for tests and fuzzing
// (SearchOptions::audit). All throw AssertionFailed, and say what is wrong, where it is not.
#pragma once

#include <span>

#include "planning/conflict_avoidance_table.h"
#include "search/node.h"

namespace grove::detail {

// The node's cost is the sum of its paths' lengths; each path is a walk from the agent's start that
// visits its tasks and ends where the agent may, and in scope it obeys all that the node demands of
// the agent; the bound is at least the cost and at least the parent's bound.
void audit(const Problem& problem, const Node& node, std::span<const AgentIndex> scope);

// The table counts the conflicts of each of `paths` (by AgentIndex; empty: not in it) as a table
// made of them anew would.
void audit(const Problem& problem, const ConflictAvoidanceTable& table,
           std::span<const Path> paths);

}  // namespace grove::detail
