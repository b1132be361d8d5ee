// SPDX-License-Identifier: MIT
// The live nodes of a run, as the ledger sees them.
#pragma once

#include <cstdint>
#include <span>

#include "search/node.h"

namespace grove::detail {

// Where they are: in one frontier, or with many ranks.
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

  // No plan in a live node, or in one that was given up, costs less.
  virtual Cost bound() const = 0;
  // The least bound of those given up.
  virtual Cost evicted_bound() const = 0;
  // False only if no node is live.
  virtual bool any() const = 0;
  virtual Counts counts() const = 0;

  virtual void push(const NodePtr& root) = 0;
  // Drops nodes whose bound is at least `cost`, which a checked plan costs.
  virtual void prune(Cost cost) = 0;
  // See Frontier::restart().
  virtual void restart(std::span<const NodePtr> roots, Cost proven) = 0;
};

}  // namespace grove::detail
