// SPDX-License-Identifier: MIT
// Tree of coordinators over the ranks.
#pragma once

#include <cstdint>
#include <vector>

namespace grove::detail {

// Address of a receiver on a rank: at level 0 the rank itself, at a higher level the coordinator of
// that level.
struct Endpoint {
  int rank = 0;
  int level = 0;

  friend bool operator==(const Endpoint&, const Endpoint&) = default;
};

// Consecutive ranks form groups, each with a coordinator of level 1 on its first rank. Consecutive
// groups form groups with a coordinator of level 2, again on the first rank, and so on up to the
// top coordinator, on rank 0. Immutable: any thread may read it.
class Hierarchy {
 public:
  // Uses the minimum number of levels with at most `max_children` children per coordinator, and
  // then the minimum number of children. `ranks` >= 1, `max_children` >= 2.
  Hierarchy(int ranks, std::int64_t max_children);

  int ranks() const { return ranks_; }
  // Number of coordinator levels, >= 1.
  int levels() const { return static_cast<int>(strides_.size()) - 1; }
  Endpoint top() const { return {0, levels()}; }
  // The highest level of a coordinator on `rank`. 0 if there is none.
  int highest_at(int rank) const;

  // The parent of `post`, which is not the top.
  Endpoint parent(Endpoint post) const;
  // The number of children of the coordinator at `post`.
  int children(Endpoint post) const;
  Endpoint child(Endpoint post, int number) const;
  // The number of the child that `rank` is or is below. `rank` must be below `post`.
  int child_with(Endpoint post, int rank) const;
  bool is_below(Endpoint post, int rank) const;

 private:
  int ranks_;
  std::vector<int> strides_;  // by level: ranks from one coordinator to the next
};

}  // namespace grove::detail
