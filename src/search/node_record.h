// SPDX-License-Identifier: MIT
// Serializable constraint-tree node without its ancestors.
#pragma once

#include <cstdint>
#include <vector>

#include "search/node.h"

namespace grove::detail {

// All constraints, paths and bounds of a node, and the number of its tree. A value.
struct NodeRecord {
  struct Walk {
    AgentIndex agent = -1;
    std::uint32_t steps = 0;
    std::vector<std::uint64_t> words;  // see packed_path.h
    friend bool operator==(const Walk&, const Walk&) = default;
  };

  std::uint32_t tree = 0;                    // number of its tree
  std::vector<AgentConstraint> constraints;  // from the root downwards
  std::vector<Walk> paths;                   // those that differ from the root's, by agent
  Cost cost = 0;
  Cost bound = 0;
  std::uint32_t conflicts = 0;
  bool bounded = false;
  friend bool operator==(const NodeRecord&, const NodeRecord&) = default;
};

// O(depth + length of the paths).
NodeRecord record_of(const Node& node);

// Throws std::invalid_argument if the record cannot be one of this instance: an agent or place that
// does not exist, a path that is no walk, a bound below the root's or below its cost.
void check(const NodeRecord& record, const Node& root, const Instance& instance);

// Recreates the node below the root of its tree, or below the root of a tree that fixes the same.
// Its new ancestors hold only its constraints. Throws as check() does.
NodePtr node_of(const NodeRecord& record, const NodePtr& root, const Instance& instance);

}  // namespace grove::detail
