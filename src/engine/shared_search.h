// SPDX-License-Identifier: MIT
// What the workers of a process have in common.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>

#include "engine/lagrangian_scheduler.h"
#include "engine/local_nodes.h"
#include "engine/run_statistics.h"
#include "engine/shared_bounds.h"
#include "engine/solve.h"
#include "engine/tree_source.h"
#include "engine/work_observer.h"
#include "search/expander.h"
#include "search/result_cache.h"

namespace grove::detail {

class MemoryBudgets;

// The nodes that this process holds. CTS-CBS (paper, Algorithms 1 and 4) is what happens when
// workers take nodes here and bring back what they led to. All methods may be called from any
// thread; none waits longer than it takes another to do the like.
class SharedSearch {
 public:
  // All must outlive this.
  SharedSearch(const SolveOptions& options, const Limits& limits, LocalNodes& nodes,
               SharedBounds& ledger, TreeSource& trees, WorkObserver& observer);
  ~SharedSearch();

  SharedBounds& ledger() { return ledger_; }
  TreeSource& trees() { return trees_; }
  WorkObserver& observer() { return observer_; }
  LagrangianScheduler& lagrangian() { return lagrangian_; }
  bool over() const { return ledger_.over(); }

  // A node to expand; null if there is none just now. Whoever takes it brings it back by finish().
  NodePtr take();
  // What became of a node taken, in the hands of the worker of this number.
  void finish(const NodePtr& node, Expansion expansion, int worker);
  // A node, perhaps in other hands, that came back unfinished last; null if it has been finished.
  NodePtr unfinished() const;
  // Do others wait for nodes to expand, so that nodes are to be expanded in haste? Others say so.
  BoundingEffort bounding_effort() const { return bounding_effort_; }
  void set_bounding_effort(BoundingEffort bounding_effort) { bounding_effort_ = bounding_effort; }
  // Is there something for an idle worker to take, or to find out?
  bool may_take() const {
    return frontier_.open() > 0 || frontier_.live() == 0 || lagrangian_.has_jobs();
  }

  // Is more proven beside the tree than by its nodes?
  bool tree_bound_is_dominated() const { return frontier_.bound() < ledger_.lower_bound(); }

  // Does the best plan cost much more than what is proven?
  bool gap_is_large() const;

  // Gives up nodes, and what was found out, as memory demands.
  void keep_within_memory();
  // What was found out, for expanders to go on with.
  std::shared_ptr<SharedCache> memory() const;
  // Is there room there for what others found out?
  bool has_room_for_facts() const;

  // Adds what was counted here to the answer's statistics.
  void add_counts(Stats& stats) const;
  // What this process holds now.
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
  SharedBounds& ledger_;
  TreeSource& trees_;
  WorkObserver& observer_;
  LagrangianScheduler lagrangian_;

  std::atomic<std::int64_t> nodes_generated_{0};
  std::atomic<std::int64_t> nodes_evicted_{0};
  std::atomic<std::uint32_t> estimates_turn_{0};
  std::atomic<BoundingEffort> bounding_effort_{BoundingEffort::kFull};

  std::mutex keeping_;  // guards the shares
  const std::unique_ptr<MemoryBudgets> shares_;

  std::atomic<std::size_t> most_known_;  // bytes of what was found out
  mutable std::mutex knowing_;
  std::shared_ptr<SharedCache> known_;  // under knowing_: GCC 11 has no std::atomic of these

  mutable std::mutex helping_;
  NodePtr unfinished_;  // under helping_
};

}  // namespace grove::detail
