// SPDX-License-Identifier: MIT
// Consistency checks of nodes and conflict avoidance tables (SearchOptions::audit). They are slow
// and serve tests and fuzzing. Each throws AssertionFailed, which describes the first violation.
#pragma once

#include <span>

#include "planning/conflict_avoidance_table.h"
#include "search/node.h"

namespace grove::detail {

// Checks a node. Its cost must be the sum of the costs of its paths. Each path must be a walk from
// its agent's start that visits all tasks of the agent and ends where the agent may rest. The paths
// of the agents in `scope` must satisfy the node's constraints. The bound must be at least the cost
// and at least the parent's bound.
void audit(const Problem& problem, const Node& node, std::span<const AgentIndex> scope);

// Checks that, for each path, `table` counts the same number of conflicts as a new table of all
// `paths`. `paths` is indexed by AgentIndex; an empty path is not in the table.
void audit(const Problem& problem, const ConflictAvoidanceTable& table,
           std::span<const Path> paths);

}  // namespace grove::detail
