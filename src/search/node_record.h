// SPDX-License-Identifier: MIT
// A constraint-tree node without its ancestors, to be kept or sent elsewhere.
#pragma once

#include <cstdint>
#include <vector>

#include "search/node.h"

namespace grove::detail {

// All that a node demands and is, and which tree it belongs to. A value.
struct NodeRecord {
  struct Walk {
    AgentIndex agent = -1;
    std::uint32_t steps = 0;
    std::vector<std::uint64_t> words;  // see packed_path.h
    friend bool operator==(const Walk&, const Walk&) = default;
  };

  std::uint32_t tree = 0;                    // its number
  std::vector<AgentConstraint> constraints;  // in the order in which they were made
  std::vector<Walk> paths;                   // those that are not the tree's, by agent
  Cost cost = 0;
  Cost bound = 0;
  std::uint32_t conflicts = 0;
  bool bounded = false;
  friend bool operator==(const NodeRecord&, const NodeRecord&) = default;
};

// O(depth + length of the paths).
NodeRecord record_of(const Node& node);

// Throws std::invalid_argument for a record that cannot be of this instance: an agent that is not
// there, a path that is none, a bound below the root's.
void check(const NodeRecord& record, const Node& root, const Instance& instance);

// The node again, below the root of its tree, or of one that fixes the same. Ancestors are made for
// it that have its constraints and nothing else. Throws as check() does.
NodePtr node_of(const NodeRecord& record, const NodePtr& root, const Instance& instance);

}  // namespace grove::detail
