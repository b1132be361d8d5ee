// SPDX-License-Identifier: MIT
// Interface to the live nodes of a run, for CentralBounds and CentralTrees.
#pragma once

#include <cstdint>
#include <span>

#include "search/node.h"

namespace grove::detail {

// The nodes are in one frontier, or distributed over ranks.
class LiveNodes {
 public:
  struct Counts {
    std::int64_t expanded = 0;
    std::int64_t open = 0;
  };

  LiveNodes() = default;
  LiveNodes(const LiveNodes&) = delete;
  LiveNodes& operator=(const LiveNodes&) = delete;
  virtual ~LiveNodes() = default;

  // Lower bound on all plans in live and in evicted nodes.
  virtual Cost bound() const = 0;
  // Least bound of an evicted node; kInfiniteCost: none.
  virtual Cost evicted_bound() const = 0;
  // False only if no node is live.
  virtual bool any() const = 0;
  virtual Counts counts() const = 0;

  virtual void push(const NodePtr& root) = 0;
  // Drops nodes whose bound is at least `cost`, the cost of a checked plan.
  virtual void prune(Cost cost) = 0;
  // See Frontier::restart().
  virtual void restart(std::span<const NodePtr> roots, Cost proven) = 0;
};

}  // namespace grove::detail
