// SPDX-License-Identifier: MIT
#include "baselines/spanning_tree_bound.h"

#include <algorithm>
#include <bit>

namespace grove::detail {

SpanningTreeBound::SpanningTreeBound(const AgentStops& stops)
    : stops_(stops),
      destination_(stops.destination() ? stops.count() : kNowhere),
      index_(static_cast<std::size_t>(stops.count()) + 1) {}

Time SpanningTreeBound::operator()(StopSet left, int at) {
  const auto next = static_cast<std::uint32_t>(known_.size());
  const std::uint32_t number = index_[static_cast<std::size_t>(at) + 1].insert(left, next);
  if (number == next) known_.push_back(tree(left, at));
  return known_[number];
}

// Prim's algorithm, starting from an arbitrary goal.
Time SpanningTreeBound::tree(StopSet left, int at) {
  outside_.clear();
  if (at != kNowhere) outside_.push_back(at);
  if (destination_ != kNowhere) outside_.push_back(destination_);
  for (StopSet rest = left; rest != 0; rest &= rest - 1) outside_.push_back(std::countr_zero(rest));
  nearest_.assign(outside_.size(), kNever);
  Time total = 0;
  for (std::size_t last = outside_.size(); last > 1; --last) {
    const int added = outside_[last - 1];  // joins the tree
    std::size_t next = 0;
    for (std::size_t i = 0; i + 1 < last; ++i) {
      nearest_[i] = std::min(nearest_[i], distance(added, outside_[i]));
      if (nearest_[i] < nearest_[next]) next = i;
    }
    if (nearest_[next] == kNever) return kNever;
    total += nearest_[next];
    std::swap(outside_[next], outside_[last - 2]);
    std::swap(nearest_[next], nearest_[last - 2]);
  }
  return total;
}

// Distance between two goals. Distances are symmetric in the worlds of the baselines.
Time SpanningTreeBound::distance(int from, int to) const {
  if (from == destination_) std::swap(from, to);
  const Cell cell = stops_.place(from);
  return to == destination_ ? stops_.to_rest(cell) : stops_.distance(cell, to);
}

}  // namespace grove::detail
