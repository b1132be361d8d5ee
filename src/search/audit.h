// SPDX-License-Identifier: MIT
// Consistency checks of nodes and conflict tables. Slow: for tests and fuzzing
// (SearchOptions::audit). All throw AssertionFailed with a description of the first violation.
#pragma once

#include <span>

#include "planning/conflict_avoidance_table.h"
#include "search/node.h"

namespace grove::detail {

// Checks a node. Its cost must be the sum of its paths' lengths. Each path must be a walk from the
// agent's start that visits its tasks and ends where the agent may rest. The paths of the agents in
// `scope` must satisfy the node's constraints. The bound must be at least the cost and at least the
// parent's bound.
void audit(const Problem& problem, const Node& node, std::span<const AgentIndex> scope);

// Checks that `table` counts as many conflicts of each path as a new table made of `paths` (by
// AgentIndex; empty: not in the table).
void audit(const Problem& problem, const ConflictAvoidanceTable& table,
           std::span<const Path> paths);

}  // namespace grove::detail
