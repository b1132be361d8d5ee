// SPDX-License-Identifier: MIT
// Budgets for nodes and cached results, and what is evicted when memory is short.
#include "engine/search_memory.h"

#include <malloc.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "model/assert.h"
#include "model/limits.h"

namespace grove::detail {
namespace {

constexpr std::size_t kMaxCacheBytes = std::size_t{1} << 29;  // max. bytes of cached results

constexpr std::size_t kNoLimit = std::numeric_limits<std::size_t>::max();
constexpr std::size_t kMinCacheBytes = 64 << 10;  // bytes; smaller budgets bring no benefit

// Bytes left below `limit`; 0 above it.
std::size_t room(std::size_t limit) {
  return limit - std::min(limit, resident_bytes());
}

}  // namespace

// Memory budgets of a process for the two kinds of memory that the search can free: nodes and the
// expanders' caches. One thread at a time.
//
// Problem: the memory limit applies to the resident set, but the resident set cannot be controlled
// by eviction. Memory that evicted nodes free is reused for the next nodes and mostly not returned
// to the system, so a search that evicted until the resident set fell would evict everything.
//
// Solution: use two measurements. The resident set decides when memory is short: when it has used
// 7/8 of the room below the limit at the start. The evictable memory, as the search itself counts
// it, is then taken as the amount that fits. From then on nodes may hold half of this amount, and
// the expanders' caches only three eighths, because their arrays double as they grow. The resident
// set should then no longer rise. If it still rises, because other parts grow or because of
// fragmentation, the next alarm is half way to the limit, and the budgets are cut again. Each cut
// takes an eighth and halves the room, so there are few cuts. If this does not suffice, the memory
// limit stops the run.
class MemoryBudgets {
 public:
  // `limits` must outlive this object. `node_bytes`: initial budget for nodes, in bytes.
  MemoryBudgets(const Limits& limits, std::size_t node_bytes);

  // True if the process is near its limit despite the current budgets.
  bool is_short() const {  // last_resident() can be older than the last cut
    return limits_.last_resident() > alarm_ && resident_bytes() > alarm_;
  }
  // Cuts the budgets, given the bytes held now. The caller then evicts down to both budgets,
  // returns free memory to the system, and calls memory_returned().
  void cut(std::size_t nodes_hold, std::size_t expanders_hold);
  void memory_returned();

  // Budgets in bytes.
  std::size_t for_nodes() const { return for_nodes_; }
  std::size_t for_expanders() const { return for_expanders_; }

 private:
  const Limits& limits_;
  std::size_t alarm_;
  std::size_t for_nodes_;
  std::size_t for_expanders_;
};

MemoryBudgets::MemoryBudgets(const Limits& limits, std::size_t node_bytes)
    : limits_(limits), alarm_(kNoLimit), for_nodes_(node_bytes), for_expanders_(kNoLimit) {
  if (const auto limit = limits.memory_limit()) alarm_ = *limit - room(*limit) / 8;
}

void MemoryBudgets::cut(std::size_t nodes_hold, std::size_t expanders_hold) {
  const std::size_t held =
      std::min(nodes_hold, for_nodes_) + std::min(expanders_hold, for_expanders_);
  for_nodes_ = std::min(for_nodes_, std::max(kMinCacheBytes, held / 2));
  for_expanders_ = std::min(for_expanders_, std::max(kMinCacheBytes, held / 8 * 3));
}

void MemoryBudgets::memory_returned() {
  const std::size_t limit = *limits_.memory_limit();
  alarm_ = std::max(alarm_, limit - room(limit) / 2);
}

SearchMemory::SearchMemory(const SolveOptions& options, const Limits& limits, LocalNodes& nodes,
                           WorkObserver& observer)
    : nodes_(nodes),
      observer_(observer),
      budgets_(std::make_unique<MemoryBudgets>(limits, options.node_memory)),
      max_cache_bytes_(kMaxCacheBytes),
      cache_(std::make_shared<SharedCache>()) {}

SearchMemory::~SearchMemory() = default;

// Evicts the worst nodes if memory is short, and replaces the cache if it is full. The worst nodes
// include those that need not be expanded because the incumbent is within w of their bound. A
// replaced cache is freed when its last user releases it.
void SearchMemory::keep_within_memory() {
  const std::unique_lock lock(keeping_, std::try_to_lock);
  if (!lock) return;
  const std::size_t cached = cache()->bytes();
  if (budgets_->is_short()) {
    budgets_->cut(nodes_.pool.bytes(), cached);
    evict_to(budgets_->for_nodes());
    ::malloc_trim(0);
    budgets_->memory_returned();
  } else if (nodes_.pool.bytes() > budgets_->for_nodes()) {
    evict_to(budgets_->for_nodes() / 8 * 7);
  }
  max_cache_bytes_ = std::min(kMaxCacheBytes, budgets_->for_expanders());
  if (cached <= max_cache_bytes_) return;
  auto next = std::make_shared<SharedCache>(SharedCache::Successor{});
  const std::lock_guard lock_cache(caching_);  // the old cache is freed after the lock is released
  cache_.swap(next);
}

std::shared_ptr<SharedCache> SearchMemory::cache() const {
  const std::lock_guard lock(caching_);
  return cache_;
}

// Results from other ranks can fill half of the cache; the other half is for local results. A full
// cache is replaced by an empty one.
bool SearchMemory::has_room_for_facts() const {
  return cache()->bytes() < max_cache_bytes_ / 2;
}

// Keeps the best open node. Evicting a leaf also frees the ancestors that no other node shares.
void SearchMemory::evict_to(std::size_t bytes) {
  while (nodes_.pool.bytes() > bytes && nodes_.frontier.open() > 1) {
    const auto evicted = nodes_.frontier.evict(nodes_.frontier.open() / 16 + 1, 1);
    observer_.evicted(evicted);
    nodes_evicted_ += std::ssize(evicted);
  }
}

MemoryUse SearchMemory::memory_use() const {
  const auto cached = cache();
  return {.process = static_cast<std::int64_t>(resident_bytes()),
          .nodes = static_cast<std::int64_t>(nodes_.pool.bytes()),
          .prices = static_cast<std::int64_t>(cached->subproblems.bytes()),
          .path_sets = static_cast<std::int64_t>(cached->mdds.bytes()),
          .groups = static_cast<std::int64_t>(cached->excesses.bytes())};
}

}  // namespace grove::detail
