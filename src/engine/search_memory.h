// SPDX-License-Identifier: MIT
// Memory of a process that the search can free: nodes and cached results.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>

#include "engine/live_nodes.h"
#include "engine/run_observer.h"
#include "engine/run_statistics.h"
#include "engine/solve.h"
#include "search/result_cache.h"

namespace grove::detail {

class MemoryBudgets;

// The cached results that the expanders of a process share, and the memory budgets for them and for
// the nodes. Thread-safe.
class SearchMemory {
 public:
  // All arguments must outlive this object.
  SearchMemory(const SolveOptions& options, const Limits& limits, LocalNodes& nodes,
               WorkObserver& observer);
  ~SearchMemory();

  // Evicts nodes and cached results if memory is short.
  void keep_within_memory();
  // The cached results; see keep_within_memory() in the .cpp for when they are replaced.
  std::shared_ptr<SharedCache> cache() const;
  // True if the cache has room for results from other ranks.
  bool has_room_for_facts() const;

  std::int64_t nodes_evicted() const { return nodes_evicted_; }
  // Memory that this process uses now.
  MemoryUse memory_use() const;

 private:
  void evict_to(std::size_t bytes);

  LocalNodes& nodes_;
  WorkObserver& observer_;
  std::atomic<std::int64_t> nodes_evicted_{0};

  std::mutex keeping_;  // guards the budgets
  const std::unique_ptr<MemoryBudgets> budgets_;

  std::atomic<std::size_t> max_cache_bytes_;  // maximum size of the cached results in bytes
  mutable std::mutex caching_;
  std::shared_ptr<SharedCache>
      cache_;  // guarded by caching_: GCC 11 has no std::atomic<std::shared_ptr>
};

}  // namespace grove::detail
