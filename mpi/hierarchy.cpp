// SPDX-License-Identifier: MIT
#include "mpi/hierarchy.h"

#include <algorithm>

#include "model/assert.h"

namespace grove::detail {
namespace {

int min_levels(int ranks, std::int64_t children) {
  int levels = 1;
  for (std::int64_t below = children; below < ranks; below *= children) ++levels;
  return levels;
}

}  // namespace

Hierarchy::Hierarchy(int ranks, std::int64_t max_children) : ranks_(ranks), strides_{1} {
  const int levels = min_levels(ranks, max_children);
  int children = 2;
  while (min_levels(ranks, children) > levels) ++children;
  for (int level = 1; level < levels; ++level) strides_.push_back(strides_.back() * children);
  strides_.push_back(ranks);
  GROVE_CHECK(std::ranges::is_sorted(strides_), "coordinators of a higher level are farther apart");
  GROVE_CHECK(this->children(top()) <= max_children, "no coordinator has too many children");
  GROVE_ASSERT(is_partition(), "each rank and coordinator is a child of exactly one coordinator");
}

// Tests every rank at every level below the top.
bool Hierarchy::is_partition() const {
  for (int level = 0; level < levels(); ++level)
    for (int rank = 0; rank < ranks_; rank += strides_[static_cast<std::size_t>(level)]) {
      const Endpoint post{rank, level};
      const Endpoint above = parent(post);
      const int number = child_with(above, rank);
      if (number < 0 || number >= children(above) || child(above, number) != post) return false;
    }
  return true;
}

int Hierarchy::highest_at(int rank) const {
  int level = 0;
  while (level < levels() && rank % strides_[static_cast<std::size_t>(level) + 1] == 0) ++level;
  return level;
}

Endpoint Hierarchy::parent(Endpoint post) const {
  const int stride = strides_[static_cast<std::size_t>(post.level) + 1];
  return {post.rank / stride * stride, post.level + 1};
}

int Hierarchy::children(Endpoint post) const {
  const int end = std::min(ranks_, post.rank + strides_[static_cast<std::size_t>(post.level)]);
  return child_with(post, end - 1) + 1;
}

Endpoint Hierarchy::child(Endpoint post, int number) const {
  const int stride = strides_[static_cast<std::size_t>(post.level) - 1];
  return {post.rank + number * stride, post.level - 1};
}

int Hierarchy::child_with(Endpoint post, int rank) const {
  GROVE_CHECK(is_below(post, rank), "the rank is below the coordinator");
  return (rank - post.rank) / strides_[static_cast<std::size_t>(post.level) - 1];
}

bool Hierarchy::is_below(Endpoint post, int rank) const {
  return rank >= post.rank && rank < post.rank + strides_[static_cast<std::size_t>(post.level)];
}

}  // namespace grove::detail
