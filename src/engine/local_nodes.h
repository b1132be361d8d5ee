// SPDX-License-Identifier: MIT
// Nodes of one process.
#pragma once

#include <atomic>
#include <cstdint>

#include "engine/live_nodes.h"
#include "search/frontier.h"
#include "search/node_pool.h"

namespace grove::detail {

// A frontier, the pool in which its nodes are made, and the number of nodes expanded. All members
// are thread-safe.
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
