// SPDX-License-Identifier: MIT
// Proven excesses of pairs and groups of agents at nodes, as values that are sent with the nodes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/instance.h"
#include "search/dependency_table.h"
#include "search/node.h"
#include "search/result_cache.h"

namespace grove::detail {

// Excess (dependency_table.h) of two or more agents under the constraints of one node in a list of
// nodes.
struct GroupBound {
  std::int32_t node = 0;           // index in the list of nodes
  std::vector<AgentIndex> agents;  // in ascending order
  DependencyTable::ExcessBound known;
};

// Returns the entries of `memory` on pairs and groups of agents at `nodes`, each entry at one node
// where it holds. Looks up all pairs and groups at the first node, and at each later node only
// those with a subproblem that no earlier node has. It therefore omits entries whose subproblems
// all occur at earlier nodes, but never together at one of them.
std::vector<GroupBound> group_bounds_of(std::span<const NodePtr> nodes, SharedCache& memory);

// Merges `findings`, received from another worker or rank, into `memory`. Ignores findings about a
// node that is nullptr. Throws std::invalid_argument if a finding names a node or an agent that
// does not exist, if it has fewer than two agents or they are not in ascending order, or if its
// excess is negative; findings before it may have been merged.
void merge(std::span<const GroupBound> findings, std::span<const NodePtr> nodes,
           SharedCache& memory);

}  // namespace grove::detail
