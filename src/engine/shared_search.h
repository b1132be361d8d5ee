// SPDX-License-Identifier: MIT
// State that the workers of a process share, and the interface to the trees of the run.
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

// Supplies trees when they are due. CentralTrees implements it in the process that owns the trees;
// this base class, for other processes, supplies none. Thread-safe. No function waits for another
// thread: while one thread supplies a tree, the calls of other threads do nothing.
class TreeSource {
 public:
  TreeSource() = default;
  TreeSource(const TreeSource&) = delete;
  TreeSource& operator=(const TreeSource&) = delete;
  virtual ~TreeSource() = default;

  // Instantiates the next tree if Algorithm 4 of the paper requires it. Must be called before a
  // node is taken.
  virtual void instantiate_due_tree() {}
  // Supplies nodes, or ends the run if there are none. Must be called only if no node is live here.
  virtual void refill_nodes() {}
  // Returns true if the caller may prepare the next tree before Algorithm 4 of the paper requires
  // it; the caller must then call prepare_tree(). Only one caller at a time gets true.
  virtual bool claim_preparation() { return false; }
  virtual void prepare_tree() {}
};

class MemoryBudgets;

// Nodes and cached results of this process. The workers' loop over take() and finish() is CTS-CBS
// (paper, Algorithms 1 and 4). Thread-safe. No function waits longer than a similar call on another
// thread takes.
class SharedSearch {
 public:
  // All arguments must outlive this object.
  SharedSearch(const SolveOptions& options, const Limits& limits, LocalNodes& nodes,
               SharedBounds& shared_bounds, TreeSource& trees, WorkObserver& observer);
  ~SharedSearch();

  SharedBounds& shared_bounds() { return shared_bounds_; }
  TreeSource& trees() { return trees_; }
  WorkObserver& observer() { return observer_; }
  LagrangianScheduler& lagrangian() { return lagrangian_; }
  bool over() const { return shared_bounds_.over(); }

  // Takes a node to expand. Returns nullptr if no node is open. The caller must return the node by
  // finish().
  NodePtr take();
  // Returns a taken node with its expansion. `worker` is the number of the worker that expanded it.
  void finish(const NodePtr& node, Expansion expansion, int worker);
  // The node that was last returned with an unfinished expansion, even if a worker has taken it
  // again; nullptr if its expansion has been finished since.
  NodePtr unfinished() const;
  // Effort to spend on bounding nodes. A rank reduces it while other ranks wait for nodes.
  BoundingEffort bounding_effort() const { return bounding_effort_; }
  void set_bounding_effort(BoundingEffort bounding_effort) { bounding_effort_ = bounding_effort; }
  // True if an idle worker can find a work item.
  bool may_take() const {
    return frontier_.open() > 0 || frontier_.live() == 0 || lagrangian_.has_jobs();
  }

  // True if the lower bound proven outside the tree search exceeds that of the nodes.
  bool tree_bound_is_dominated() const { return frontier_.bound() < shared_bounds_.lower_bound(); }

  // True if the gap exceeds large_gap.
  bool gap_is_large() const;

  // Evicts nodes and cached results if memory is short.
  void keep_within_memory();
  // Cached results, for the expanders.
  std::shared_ptr<SharedCache> memory() const;
  // True if the cache has room for results from other ranks.
  bool has_room_for_facts() const;

  // Adds the counts of this object to the statistics of the solution.
  void add_counts(Stats& stats) const;
  // Memory that this process uses now.
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
  const std::unique_ptr<MemoryBudgets> budgets_;

  std::atomic<std::size_t> max_cache_bytes_;  // maximum size of the cached results in bytes
  mutable std::mutex knowing_;
  std::shared_ptr<SharedCache>
      cache_;  // guarded by knowing_: GCC 11 has no std::atomic<std::shared_ptr>

  mutable std::mutex helping_;
  NodePtr unfinished_;  // guarded by helping_
};

}  // namespace grove::detail
