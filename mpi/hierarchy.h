// SPDX-License-Identifier: MIT
// Who answers to whom, where there are many ranks.
#pragma once

#include <cstdint>
#include <vector>

namespace grove::detail {

// Who is meant on a rank: at level 0 the rank itself, above it the coordinator of that level.
struct Endpoint {
  int rank = 0;
  int level = 0;

  friend bool operator==(const Endpoint&, const Endpoint&) = default;
};

// Neighbouring ranks make groups, each with a coordinator of level 1 on its first rank;
// neighbouring groups make groups with a coordinator of level 2, on the first rank again; up to the
// one over all, on rank 0. Immutable; may be used from any thread.
class Hierarchy {
 public:
  // With as few levels as there can be with at most `most_children` below each, and then as few
  // children. From 1 and from 2.
  Hierarchy(int ranks, std::int64_t most_children);

  int ranks() const { return ranks_; }
  // Of coordinators; 1 or more.
  int levels() const { return static_cast<int>(strides_.size()) - 1; }
  Endpoint top() const { return {0, levels()}; }
  // The highest at that rank; 0 where there is no coordinator.
  int highest_at(int rank) const;

  // Whom the one at this post answers to, which is not the top.
  Endpoint parent(Endpoint post) const;
  // How many answer to the coordinator at this post.
  int children(Endpoint post) const;
  Endpoint child(Endpoint post, int number) const;
  // The number of the child that this rank is, or is below; of one that is below the post.
  int child_with(Endpoint post, int rank) const;
  bool is_below(Endpoint post, int rank) const;

 private:
  int ranks_;
  std::vector<int> strides_;  // by level: from one coordinator to the next
};

}  // namespace grove::detail
