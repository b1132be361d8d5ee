// SPDX-License-Identifier: MIT
// Live nodes of a run: the interface that CentralBounds and CentralTrees use, and its
// implementation for the nodes of one process.
#pragma once

#include <atomic>
#include <cstdint>
#include <span>

#include "search/frontier.h"
#include "search/node.h"
#include "search/node_pool.h"

namespace grove::detail {

// The live nodes of a run, in one frontier or distributed over ranks.
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
  // Least bound of the nodes evicted since the last restart and not pruned; kInfiniteCost if there
  // is none.
  virtual Cost evicted_bound() const = 0;
  // False only if no node is live.
  virtual bool any() const = 0;
  virtual Counts counts() const = 0;

  virtual void push(const NodePtr& root) = 0;
  // Drops the open nodes with a bound of at least `cost`, which must be the cost of a checked plan.
  virtual void prune(Cost cost) = 0;
  // See Frontier::restart().
  virtual void restart(std::span<const NodePtr> roots, Cost proven) = 0;
};

// Nodes of one process: a frontier, the pool in which its nodes are made, and the number of nodes
// expanded. Thread-safe.
struct LocalNodes : LiveNodes {
  LocalNodes() = default;
  ~LocalNodes() override { frontier.abandon(); }

  Cost bound() const override { return frontier.bound(); }
  Cost evicted_bound() const override { return frontier.evicted_bound(); }
  bool any() const override { return frontier.live() > 0; }
  Counts counts() const override { return {expanded, static_cast<std::int64_t>(frontier.open())}; }
  void push(const NodePtr& root) override { frontier.push(root); }
  void prune(Cost cost) override { frontier.prune(cost); }
  void restart(std::span<const NodePtr> roots, Cost proven) override {
    frontier.restart(roots, proven);
  }

  NodePool pool;
  Frontier frontier;
  std::atomic<std::int64_t> expanded{0};
};

}  // namespace grove::detail
