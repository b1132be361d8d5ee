// SPDX-License-Identifier: MIT
// Eviction of open nodes when memory is short, and why the bound stays valid.
//
// evict() drops the worst open nodes. Let E be the least bound of a dropped node. *Claim:
// min(bounds of live nodes, E) is a lower bound on every plan of the pushed nodes that is not in a
// pruned node.* A plan of a dropped node is in no live node, but it costs at least the bound of
// that node, hence at least E. This bound cannot rise above E: an empty frontier proves E and no
// more, unless the incumbent costs at most E, because then the dropped nodes could as well have
// been pruned.
//
// *Restart.* When no node is live but some were dropped, the caller restarts from the roots. Every
// plan of these trees is then known to cost at least E, or at least as much as the incumbent. In
// the second run a node therefore ranks by max(bound, E). Nodes with a bound below E only have to
// be re-expanded. They are taken newest first (depth first), so that only about as many nodes are
// open as the tree is deep. This leaves the memory to the nodes above E, of which the best are kept
// again. If the nodes of one single bound exceed the memory, each run raises the bound by one. This
// is iterative deepening (Korf 1985): if each bound has twice as many nodes as the previous one,
// the last run costs more than all earlier runs together.
#include "search/frontier.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "model/assert.h"

namespace grove::detail {
namespace {

// True if the levels, which map a bound to its open nodes, hold `count` nodes, and none is empty.
bool hold(const auto& levels, std::size_t count) {
  std::size_t sum = 0;
  for (const auto& [bound, nodes] : levels) {
    if (nodes.empty()) return false;
    sum += nodes.size();
  }
  return sum == count;
}

std::size_t sum_of(const std::map<Cost, std::size_t>& counts) {
  std::size_t sum = 0;
  for (const auto& [bound, count] : counts) sum += count;
  return sum;
}

}  // namespace

void Frontier::push(NodePtr node) {
  const std::lock_guard lock(mutex_);
  push_locked(std::move(node));
}

// Order of the nodes of one rank, for heaps with the best node in front. The comparator returns
// whether `a` is worse than `b`.
auto Frontier::order_in(Cost rank) const {
  return [newest_first = rank == proven_](const Open& a, const Open& b) {
    const auto conflicts = [](const Open& open) { return open.node->conflicts(); };
    if (!newest_first && conflicts(a) != conflicts(b)) return conflicts(a) > conflicts(b);
    return a.serial < b.serial;
  };
}

void Frontier::push_locked(NodePtr node) {
  const Cost at = rank(node);
  const auto heap = open_.try_emplace(at).first;
  try {
    heap->second.push_back({serial_++, std::move(node)});
  } catch (...) {
    if (heap->second.empty()) open_.erase(heap);
    throw;
  }
  std::ranges::push_heap(heap->second, order_in(at));
  GROVE_ASSERT(!order_in(at)(heap->second.front(), heap->second.back()),
               "the first node of a heap is its best");
  ++open_count_;
}

NodePtr Frontier::take() {
  const std::lock_guard lock(mutex_);
  return open_.empty() ? nullptr : take_locked(open_.begin());
}

// Compares only the first node of each rank: except at rank proven_ (newest first), it has the
// fewest conflicts of its rank.
NodePtr Frontier::take_by_estimate(Omega omega, Cost lower_bound, double per_conflict) {
  const std::lock_guard lock(mutex_);
  const auto expected = [&](const auto& rank) {
    return static_cast<double>(rank.first) +
           per_conflict * static_cast<double>(rank.second.front().node->conflicts());
  };
  auto best = open_.end();
  for (auto it = open_.begin(); it != open_.end() && omega.accepts(it->first, lower_bound); ++it)
    if (best == open_.end() || expected(*it) < expected(*best)) best = it;
  return best == open_.end() ? nullptr : take_locked(best);
}

NodePtr Frontier::take_locked(std::map<Cost, std::vector<Open>>::iterator best) {
  in_progress_.reserve(in_progress_.size() + 1);
  std::size_t& taken = taken_[best->first];  // nothing has changed if this throws
  std::ranges::pop_heap(best->second, order_in(best->first));
  GROVE_ASSERT(!order_in(best->first)(best->second.back(), best->second.front()),
               "no node of its bound is better than the one taken");
  NodePtr node = std::move(best->second.back().node);
  best->second.pop_back();
  if (best->second.empty()) open_.erase(best);
  --open_count_;
  ++taken;
  in_progress_.push_back(node);
  return node;
}

// Takes from the second half of each heap, which consists of leaves. A leaf is no better than any
// of its ancestors in the heap, so this approximates the worse half. All memory is allocated before
// the first change, so that nothing has changed if an allocation fails.
std::vector<NodePtr> Frontier::take_for_transfer(std::size_t count, bool keeps_next) {
  const std::lock_guard lock(mutex_);
  std::vector<NodePtr> spare;
  const Node* const next = open_.empty() ? nullptr : open_.begin()->second.front().node.get();
  spare.reserve(std::min(count, open_count_));
  in_progress_.reserve(in_progress_.size() + std::min(count, open_count_));
  std::map<Cost, std::size_t> to_take;  // number of nodes of each rank
  std::size_t left = count;
  for (const auto& [rank, heap] : open_) {
    const bool is_kept = keeps_next && rank == open_.begin()->first;
    const std::size_t half = (heap.size() + (is_kept ? 0 : 1)) / 2;
    if (const std::size_t here = std::min(half, left); here > 0) to_take[rank] = here;
    left -= std::min(half, left);
    if (left == 0) break;
  }
  for (const auto& [rank, here] : to_take) {
    std::vector<Open>& heap = open_.find(rank)->second;
    for (auto it = heap.end() - static_cast<std::ptrdiff_t>(here); it != heap.end(); ++it)
      in_progress_.push_back(spare.emplace_back(std::move(it->node)));
    heap.erase(heap.end() - static_cast<std::ptrdiff_t>(here), heap.end());
    open_count_ -= here;
  }
  taken_.merge(to_take);  // keeps in `to_take` the ranks that taken_ has already
  for (const auto& [rank, here] : to_take) taken_.find(rank)->second += here;
  std::erase_if(open_, [](const auto& level) { return level.second.empty(); });
  GROVE_ASSERT(hold(open_, open_count_), "the count of open nodes is that of all levels");
  GROVE_ASSERT(
      spare.size() <= count &&
          std::ranges::is_sorted(spare, {}, [&](const NodePtr& node) { return rank(node); }),
      "nodes are taken for transfer in order of their bounds, at most as many as requested");
  GROVE_ASSERT(!keeps_next || !next || open_.begin()->second.front().node.get() == next,
               "the node that take() would return is kept");
  return spare;
}

void Frontier::complete(const NodePtr& node) {
  const std::lock_guard lock(mutex_);
  release_locked(node);
}

void Frontier::reinsert(NodePtr node) {
  const std::lock_guard lock(mutex_);
  push_locked(node);
  release_locked(node);
}

void Frontier::release_locked(const NodePtr& node) {
  const auto it = taken_.find(rank(node));
  GROVE_ASSERT(it != taken_.end() && std::ranges::count(in_progress_, node) > 0,
               "only taken nodes can be completed or reinserted");
  if (--it->second == 0) taken_.erase(it);
  std::swap(*std::ranges::find(in_progress_, node), in_progress_.back());
  in_progress_.pop_back();
  GROVE_ASSERT(sum_of(taken_) == in_progress_.size(), "each taken node is counted once");
}

std::size_t Frontier::prune(Cost bound) {
  const std::lock_guard lock(mutex_);
  std::size_t pruned = 0;
  for (auto it = open_.lower_bound(bound); it != open_.end(); it = open_.erase(it))
    pruned += it->second.size();
  open_count_ -= pruned;
  GROVE_ASSERT(open_.empty() || open_.rbegin()->first < bound,
               "no node that the incumbent prunes stays open");
  GROVE_ASSERT(hold(open_, open_count_), "the count of open nodes is that of all levels");
  if (evicted_bound_ >= bound) evicted_bound_ = kInfiniteCost;
  return pruned;
}

std::vector<NodePtr> Frontier::evict(std::size_t count, std::size_t keep) {
  const std::lock_guard lock(mutex_);
  count = std::min(count, open_count_ - std::min(open_count_, keep));
  std::vector<NodePtr> evicted;
  evicted.reserve(count);
  while (evicted.size() < count && !open_.empty()) {
    const auto worst = std::prev(open_.end());
    auto& [rank, heap] = *worst;
    evicted_bound_ = std::min(evicted_bound_, rank);
    const std::size_t left = heap.size() - std::min(heap.size(), count - evicted.size());
    const auto first = heap.begin() + static_cast<std::ptrdiff_t>(left);
    const auto worse = order_in(rank);
    if (left > 0)
      std::ranges::nth_element(heap, first,
                               [&](const Open& a, const Open& b) { return worse(b, a); });
    for (auto it = first; it != heap.end(); ++it) evicted.push_back(std::move(it->node));
    heap.erase(first, heap.end());
    std::ranges::make_heap(heap, worse);
    if (heap.empty()) open_.erase(worst);
  }
  open_count_ -= evicted.size();
  GROVE_ASSERT(evicted.size() == count && hold(open_, open_count_),
               "as many nodes are evicted as requested, and the others stay open");
  GROVE_ASSERT(std::ranges::all_of(evicted,
                                   [&](const NodePtr& node) {
                                     return rank(node) >= evicted_bound_ &&
                                            (open_.empty() || rank(node) >= open_.rbegin()->first);
                                   }),
               "evicted nodes are the worst ones, and the evicted bound covers them");
  return evicted;
}

Cost Frontier::evicted_bound() const {
  const std::lock_guard lock(mutex_);
  return evicted_bound_;
}

// Under one lock, so that no thread sees the frontier with neither nodes nor an evicted bound.
void Frontier::restart(std::span<const NodePtr> roots, Cost proven) {
  const std::lock_guard lock(mutex_);
  GROVE_ASSERT(open_.empty() && taken_.empty(), "a restart requires that no node is live");
  GROVE_ASSERT(proven >= proven_, "a restart lowers no proven bound");
  proven_ = proven;
  for (const NodePtr& root : roots) push_locked(root);
  evicted_bound_ = kInfiniteCost;
}

void Frontier::abandon() {
  const std::lock_guard lock(mutex_);
  for (auto& [bound, nodes] : open_)
    for (Open& open : nodes) open.node.abandon();
  for (NodePtr& node : in_progress_) node.abandon();
  in_progress_.clear();
  open_.clear();
  open_count_ = 0;
}

Frontier::Snapshot Frontier::snapshot() const {
  const std::lock_guard lock(mutex_);
  Snapshot snapshot{in_progress_, evicted_bound_};
  snapshot.live.reserve(in_progress_.size() + open_count_);
  for (const auto& [bound, heap] : open_)
    for (const Open& open : heap) snapshot.live.push_back(open.node);
  GROVE_ASSERT(snapshot.live.size() == open_count_ + in_progress_.size(),
               "a snapshot has all live nodes");
  return snapshot;
}

void Frontier::record_evicted_bound(Cost bound) {
  const std::lock_guard lock(mutex_);
  evicted_bound_ = std::min(evicted_bound_, bound);
}

Cost Frontier::bound() const {
  const std::lock_guard lock(mutex_);
  const Cost open = open_.empty() ? kInfiniteCost : open_.begin()->first;
  const Cost taken = taken_.empty() ? kInfiniteCost : taken_.begin()->first;
  GROVE_ASSERT(open >= proven_ && taken >= proven_,
               "after a restart no live node counts with less than the proven bound");
  return std::min({open, taken, evicted_bound_});
}

std::size_t Frontier::open() const {
  const std::lock_guard lock(mutex_);
  return open_count_;
}

std::vector<Frontier::Level> Frontier::levels(std::size_t max_count) const {
  const std::lock_guard lock(mutex_);
  std::vector<Level> levels;
  for (auto it = open_.begin(); it != open_.end() && levels.size() < max_count; ++it)
    levels.push_back({it->first, static_cast<std::int64_t>(it->second.size())});
  return levels;
}

std::size_t Frontier::live() const {
  const std::lock_guard lock(mutex_);
  return open_count_ + in_progress_.size();
}

}  // namespace grove::detail
