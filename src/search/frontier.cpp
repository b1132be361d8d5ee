// SPDX-License-Identifier: MIT
#include "grove/search/frontier.h"

#include <algorithm>
#include <utility>

namespace grove {

void Frontier::push(NodePtr node) {
  const std::lock_guard lock(mutex_);
  push_locked(std::move(node));
}

// The order within a bound, for heaps with the best at the front.
bool Frontier::later(const Open& a, const Open& b) {
  if (a.node->conflicts() != b.node->conflicts()) return a.node->conflicts() > b.node->conflicts();
  return a.serial < b.serial;
}

void Frontier::push_locked(NodePtr node) {
  auto& heap = open_[node->bound()];
  heap.push_back({serial_++, std::move(node)});
  std::ranges::push_heap(heap, later);
  ++open_count_;
}

NodePtr Frontier::take() {
  const std::lock_guard lock(mutex_);
  if (open_.empty()) return nullptr;
  const auto best = open_.begin();
  std::ranges::pop_heap(best->second, later);
  NodePtr node = std::move(best->second.back().node);
  best->second.pop_back();
  if (best->second.empty()) open_.erase(best);
  --open_count_;
  ++taken_[node->bound()];
  return node;
}

void Frontier::settle(const NodePtr& node) {
  const std::lock_guard lock(mutex_);
  release_locked(node->bound());
}

void Frontier::give_back(NodePtr node) {
  const std::lock_guard lock(mutex_);
  release_locked(node->bound());
  push_locked(std::move(node));
}

void Frontier::release_locked(Cost bound) {
  const auto it = taken_.find(bound);
  if (--it->second == 0) taken_.erase(it);
}

std::size_t Frontier::prune(Cost bound) {
  const std::lock_guard lock(mutex_);
  std::size_t pruned = 0;
  for (auto it = open_.lower_bound(bound); it != open_.end(); it = open_.erase(it))
    pruned += it->second.size();
  open_count_ -= pruned;
  return pruned;
}

void Frontier::abandon() {
  const std::lock_guard lock(mutex_);
  for (auto& [bound, nodes] : open_)
    for (Open& open : nodes) open.node.abandon();
  open_.clear();
  open_count_ = 0;
}

Cost Frontier::bound() const {
  const std::lock_guard lock(mutex_);
  const Cost open = open_.empty() ? kInfiniteCost : open_.begin()->first;
  const Cost taken = taken_.empty() ? kInfiniteCost : taken_.begin()->first;
  return std::min(open, taken);
}

std::size_t Frontier::open() const {
  const std::lock_guard lock(mutex_);
  return open_count_;
}

}  // namespace grove
