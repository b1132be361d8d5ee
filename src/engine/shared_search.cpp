// SPDX-License-Identifier: MIT
// Node selection. With w = 0 the best node is always taken.
//
// With w > 0, a plan within w of the lower bound ends the run at once. Any node whose bound is
// within w of the lower bound can lead to such a plan. Among these nodes the one with the least
// bound is a poor choice, because it often has many conflicts. Therefore, as in explicit estimation
// search (Li, Ruml and Koenig, AAAI 2021), every second node is selected by the expected cost of a
// plan below it. The other nodes are selected best first and raise the bound.
//
// With an incumbent of cost C, selection is best first, as with w = 0. Every node with a bound
// below C / (1 + w) must be expanded, in any order. Expanding a node above that bound could only
// yield a better plan, which neighbourhood search usually finds sooner.
//
// A node is live, and counts in the lower bound, until all its children have been pushed.
#include "engine/shared_search.h"

#include <malloc.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

#include "engine/solve.h"
#include "model/limits.h"

namespace grove::detail {
namespace {

constexpr std::size_t kMaxCacheBytes = std::size_t{1} << 29;  // max. bytes of cached results

constexpr std::size_t kNoLimit = std::numeric_limits<std::size_t>::max();
constexpr std::size_t kMinCacheBytes = 64 << 10;  // bytes; smaller budgets bring no benefit

// Bytes left below `limit`.
std::size_t room(std::size_t limit) {
  return limit - std::min(limit, resident_bytes());
}

}  // namespace

// Memory budgets of a run for the two kinds of memory that the search can evict: nodes and the
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

SharedSearch::SharedSearch(const SolveOptions& options, const Limits& limits, LocalNodes& nodes,
                           SharedBounds& shared_bounds, TreeSource& trees, WorkObserver& observer)
    : omega_(options.omega),
      uses_estimates_(techniques_of(options).has(Technique::kEstimates)),
      cost_per_conflict_(options.tuning.cost_per_conflict),
      large_gap_(options.tuning.large_gap),
      nodes_(nodes),
      pool_(nodes.pool),
      frontier_(nodes.frontier),
      shared_bounds_(shared_bounds),
      trees_(trees),
      observer_(observer),
      lagrangian_(options.tuning),
      budgets_(std::make_unique<MemoryBudgets>(limits, options.node_memory)),
      max_cache_bytes_(kMaxCacheBytes),
      cache_(std::make_shared<SharedCache>()) {}

SharedSearch::~SharedSearch() = default;

NodePtr SharedSearch::take() {
  trees_.instantiate_due_tree();
  NodePtr node = take_open();
  if (node || frontier_.live() > 0) return node;
  trees_.refill_nodes();
  return take_open();
}

NodePtr SharedSearch::take_open() {
  NodePtr node;
  if (plan_is_wanted())
    node = frontier_.take_by_estimate(omega_, shared_bounds_.lower_bound(), cost_per_conflict_);
  return node ? node : frontier_.take();
}

bool SharedSearch::gap_is_large() const {
  const Cost cost = shared_bounds_.cutoff();
  return cost<kInfiniteCost&& static_cast<double>(cost)>(1 + large_gap_) *
         static_cast<double>(shared_bounds_.lower_bound());
}

// True if the next node is to be selected by its expected plan cost.
bool SharedSearch::plan_is_wanted() {
  if (omega_ == Omega() || shared_bounds_.cutoff() < kInfiniteCost || !uses_estimates_)
    return false;
  return ++estimates_turn_ % 2 != 0;
}

NodePtr SharedSearch::unfinished() const {
  const std::lock_guard lock(helping_);
  return unfinished_;
}

void SharedSearch::finish(const NodePtr& node, Expansion expansion, int worker) {
  {
    const std::lock_guard lock(helping_);
    if (expansion.unfinished)
      unfinished_ = node;
    else if (unfinished_ == node)
      unfinished_ = nullptr;
  }
  if (expansion.stopped || expansion.unfinished) {
    frontier_.reinsert(node);
    return;
  }
  ++nodes_.expanded;
  observer_.expanded(node, expansion, worker);
  for (const NodePtr& child : expansion.children) {
    ++nodes_generated_;
    if (child->bound() < shared_bounds_.cutoff()) frontier_.push(child);
  }
  if (expansion.plan) shared_bounds_.post(std::move(*expansion.plan), PlanSource::kTree);
  frontier_.complete(node);
  shared_bounds_.nodes_changed();
}

// Evicts the worst nodes if memory is short, and replaces the cache if it is full. The worst nodes
// include those that need not be expanded because the incumbent is within w of their bound. A
// replaced cache is freed when its last user releases it.
void SharedSearch::keep_within_memory() {
  const std::unique_lock lock(keeping_, std::try_to_lock);
  if (!lock) return;
  const std::size_t known = memory()->bytes();
  if (budgets_->is_short()) {
    budgets_->cut(pool_.bytes(), known);
    evict_to(budgets_->for_nodes());
    ::malloc_trim(0);
    budgets_->memory_returned();
  } else if (pool_.bytes() > budgets_->for_nodes()) {
    evict_to(budgets_->for_nodes() / 8 * 7);
  }
  max_cache_bytes_ = std::min(kMaxCacheBytes, budgets_->for_expanders());
  if (known <= max_cache_bytes_) return;
  auto next = std::make_shared<SharedCache>(SharedCache::Successor{});
  const std::lock_guard lock_known(knowing_);  // the old cache is freed after the lock is released
  cache_.swap(next);
}

std::shared_ptr<SharedCache> SharedSearch::memory() const {
  const std::lock_guard lock(knowing_);
  return cache_;
}

// Results from other ranks can fill half of the cache; the other half is for local results. A full
// cache is replaced by an empty one.
bool SharedSearch::has_room_for_facts() const {
  return memory()->bytes() < max_cache_bytes_ / 2;
}

// Keeps the best open node. Evicting a leaf also frees the ancestors that no other node shares.
void SharedSearch::evict_to(std::size_t bytes) {
  while (pool_.bytes() > bytes && frontier_.open() > 1) {
    const auto evicted = frontier_.evict(frontier_.open() / 16 + 1, 1);
    observer_.evicted(evicted);
    nodes_evicted_ += std::ssize(evicted);
  }
}

void SharedSearch::add_counts(Stats& stats) const {
  stats.counts["nodes_expanded"] += nodes_.expanded;
  stats.counts["nodes_generated"] += nodes_generated_;
  stats.counts["nodes_evicted"] += nodes_evicted_;
  if (lagrangian_.rounds() > 0) stats.counts["lagrangian_rounds"] += lagrangian_.rounds();
  if (lagrangian_.remote_pricings() > 0)
    stats.counts["remote_pricings"] += lagrangian_.remote_pricings();
}

MemoryUse SharedSearch::memory_use() const {
  const auto known = memory();
  return {.process = static_cast<std::int64_t>(resident_bytes()),
          .nodes = static_cast<std::int64_t>(pool_.bytes()),
          .prices = static_cast<std::int64_t>(known->subproblems.bytes()),
          .path_sets = static_cast<std::int64_t>(known->mdds.bytes()),
          .groups = static_cast<std::int64_t>(known->excesses.bytes())};
}

}  // namespace grove::detail
