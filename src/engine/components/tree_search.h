// SPDX-License-Identifier: MIT
// The component that searches the constraint trees: CTS-CBS (paper, Algorithms 1 and 4).
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>

#include "engine/component.h"
#include "engine/search_memory.h"

namespace grove::detail {

// Selects nodes of this process, and stores the results of their expansion. A worker expands a node
// or, if none is open, helps another worker with its node. No function blocks for longer than a
// similar call on another thread takes.
class TreeSearch : public Component {
 public:
  explicit TreeSearch(const ComponentContext& context);

  EffortTier tier() const override { return EffortTier::kTree; }
  std::unique_ptr<WorkSource> source(int worker) override;
  bool has_work() const override;
  void add_counts(Counters& counters) const override;
  void add_memory(MemoryUse& memory) const override;
  void keep_within_memory() override { context_.memory.keep_within_memory(); }

  // Takes a node to expand. Returns nullptr if no node is open. The caller must return the node
  // with finish().
  NodePtr take();
  // Returns a taken node with its expansion. `worker` is the number of the worker that expanded it.
  void finish(const NodePtr& node, Expansion expansion, int worker);
  // The node that was last returned with an unfinished expansion, even if a worker has taken it
  // again; nullptr if its expansion has been finished since.
  NodePtr unfinished() const;

  // Effort to spend on bounding nodes. A rank reduces it while other ranks wait for nodes.
  BoundingEffort bounding_effort() const { return bounding_effort_; }
  void set_bounding_effort(BoundingEffort bounding_effort) { bounding_effort_ = bounding_effort; }

 private:
  NodePtr take_open();
  bool plan_is_wanted();

  const ComponentContext context_;
  EffortAccount account_;  // not used, because the tree search is never due
  const bool uses_estimates_;
  std::atomic<std::int64_t> nodes_generated_{0};
  std::atomic<std::uint32_t> estimates_turn_{0};
  std::atomic<BoundingEffort> bounding_effort_{BoundingEffort::kFull};

  mutable std::mutex helping_;
  NodePtr unfinished_;  // guarded by helping_
};

}  // namespace grove::detail
