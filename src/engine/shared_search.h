// SPDX-License-Identifier: MIT
// State shared by the workers of a process, and the interface to the trees of the run.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>

#include "engine/lagrangian_scheduler.h"
#include "engine/live_nodes.h"
#include "engine/run_observer.h"
#include "engine/run_statistics.h"
#include "engine/shared_bounds.h"
#include "engine/solve.h"
#include "search/expander.h"
#include "search/result_cache.h"

namespace grove::detail {

// Supplies trees when they are due. This base class never does, for processes that do not own the
// trees; CentralTrees does. Thread-safe; no method waits.
class TreeSource {
 public:
  TreeSource() = default;
  TreeSource(const TreeSource&) = delete;
  TreeSource& operator=(const TreeSource&) = delete;
  virtual ~TreeSource() = default;

  // Call before taking a node: instantiates the next tree if Algorithm 4 requires it.
  virtual void instantiate_due_tree() {}
  // Call if no node is live here: supplies nodes or finds that there are none.
  virtual void refill_nodes() {}
  // Returns true if the caller may prepare the next tree before Algorithm 4 requires it. The caller
  // must then call prepare_tree(). One caller at a time gets true.
  virtual bool claim_preparation() { return false; }
  virtual void prepare_tree() {}
};

class MemoryBudgets;

// Nodes and cached results of this process. Workers take nodes here and return the expansions: this
// is CTS-CBS (paper, Algorithms 1 and 4). Thread-safe; no method waits longer than another thread
// needs for a similar call.
class SharedSearch {
 public:
  // All must outlive this.
  SharedSearch(const SolveOptions& options, const Limits& limits, LocalNodes& nodes,
               SharedBounds& shared_bounds, TreeSource& trees, WorkObserver& observer);
  ~SharedSearch();

  SharedBounds& shared_bounds() { return shared_bounds_; }
  TreeSource& trees() { return trees_; }
  WorkObserver& observer() { return observer_; }
  LagrangianScheduler& lagrangian() { return lagrangian_; }
  bool over() const { return shared_bounds_.over(); }

  // Takes a node to expand, or returns nullptr if there is none now. The caller must return the
  // node by finish().
  NodePtr take();
  // Returns a taken node with its expansion. `worker` is the number of the worker that expanded it.
  void finish(const NodePtr& node, Expansion expansion, int worker);
  // The node that last came back unfinished, possibly taken by another worker since; nullptr if it
  // has been finished.
  NodePtr unfinished() const;
  // Effort to spend on bounding nodes. A rank reduces it while other ranks wait for nodes.
  BoundingEffort bounding_effort() const { return bounding_effort_; }
  void set_bounding_effort(BoundingEffort bounding_effort) { bounding_effort_ = bounding_effort; }
  // True if an idle worker may find work.
  bool may_take() const {
    return frontier_.open() > 0 || frontier_.live() == 0 || lagrangian_.has_jobs();
  }

  // True if more is proven outside the tree search than by its nodes.
  bool tree_bound_is_dominated() const { return frontier_.bound() < shared_bounds_.lower_bound(); }

  // True if the gap exceeds large_gap.
  bool gap_is_large() const;

  // Evicts nodes and cached results if memory is short.
  void keep_within_memory();
  // Cached results, for the expanders.
  std::shared_ptr<SharedCache> memory() const;
  // True if the cache has room for results of other ranks.
  bool has_room_for_facts() const;

  // Adds the counts of this object to the statistics of the solution.
  void add_counts(Stats& stats) const;
  // Memory that this process holds now.
  MemoryUse memory_use() const;

 private:
  NodePtr take_open();
  bool plan_is_wanted();
  void evict_to(std::size_t bytes);

  const Omega omega_;
  const bool uses_estimates_;
  const double cost_per_conflict_;
  const double large_gap_;
  LocalNodes& nodes_;
  NodePool& pool_;
  Frontier& frontier_;
  SharedBounds& shared_bounds_;
  TreeSource& trees_;
  WorkObserver& observer_;
  LagrangianScheduler lagrangian_;

  std::atomic<std::int64_t> nodes_generated_{0};
  std::atomic<std::int64_t> nodes_evicted_{0};
  std::atomic<std::uint32_t> estimates_turn_{0};
  std::atomic<BoundingEffort> bounding_effort_{BoundingEffort::kFull};

  std::mutex keeping_;  // guards the budgets
  const std::unique_ptr<MemoryBudgets> shares_;

  std::atomic<std::size_t> max_cache_bytes_;  // max. bytes of cached results
  mutable std::mutex knowing_;
  std::shared_ptr<SharedCache>
      known_;  // under knowing_: GCC 11 has no std::atomic<std::shared_ptr>

  mutable std::mutex helping_;
  NodePtr unfinished_;  // under helping_
};

}  // namespace grove::detail
