// SPDX-License-Identifier: MIT
// What is known about the agents of nodes, as values, to be told to whoever is given the nodes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/instance.h"
#include "search/dependency_table.h"
#include "search/node.h"
#include "search/result_cache.h"

namespace grove::detail {

// Of agents in the situations that they are in at one of several nodes: by how much they cost more
// together than each alone.
struct GroupBound {
  std::int32_t node = 0;           // its place among the nodes
  std::vector<AgentIndex> agents;  // two or more, in ascending order
  DependencyTable::Known known;
};

// What `memory` knows of pairs and groups of agents at these nodes, each at one node where it
// holds. O(agents squared) for the first node, and for another what is new there; not quite all of
// it: what combines situations of several earlier nodes is left out.
std::vector<GroupBound> group_bounds_of(std::span<const NodePtr> nodes, SharedCache& memory);

// Adds what others found out about these nodes to what `memory` knows. Findings about a node that
// is null are ignored. Throws std::invalid_argument, perhaps after some were added, for what cannot
// be: a node or an agent that is not there, agents in another order.
void merge(std::span<const GroupBound> findings, std::span<const NodePtr> nodes,
           SharedCache& memory);

}  // namespace grove::detail
