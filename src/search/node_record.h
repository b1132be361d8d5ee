// SPDX-License-Identifier: MIT
// Serializable constraint-tree node that does not refer to its ancestors.
#pragma once

#include <cstdint>
#include <vector>

#include "search/node.h"

namespace grove::detail {

// All constraints of a node, its paths that differ from those of the root, its cost and bound, and
// the number of its tree.
struct NodeRecord {
  struct Walk {
    AgentIndex agent = -1;
    std::uint32_t steps = 0;
    std::vector<std::uint64_t> words;  // see packed_path.h
    friend bool operator==(const Walk&, const Walk&) = default;
  };

  std::uint32_t tree = 0;                    // number of its tree
  std::vector<AgentConstraint> constraints;  // in order of depth, from the root down
  std::vector<Walk> paths;                   // those stored below the root, in order of agent
  Cost cost = 0;
  Cost bound = 0;
  std::uint32_t conflicts = 0;
  bool bounded = false;
  friend bool operator==(const NodeRecord&, const NodeRecord&) = default;
};

// Converts a node to a record.
NodeRecord record_of(const Node& node);

// Throws std::invalid_argument if `record` names an agent or place that does not exist, if a path
// has the wrong number of words or is not a walk from its agent's start, or if the bound is below
// the root's bound or below the cost of the record. Detects no other error.
void check(const NodeRecord& record, const Node& root, const Instance& instance);

// Recreates the node below `root`, the root of its tree or of a tree that fixes the same. The nodes
// between them are new; each adds one of the constraints. Throws as check() does.
NodePtr node_of(const NodeRecord& record, const NodePtr& root, const Instance& instance);

}  // namespace grove::detail
