// SPDX-License-Identifier: MIT
// Tree of coordinators over the ranks.
#pragma once

#include <cstdint>
#include <vector>

namespace grove::detail {

// Address of a message receiver on a rank. Level 0 is the rank itself; a higher level is the
// coordinator of that level on this rank.
struct Endpoint {
  int rank = 0;
  int level = 0;

  friend bool operator==(const Endpoint&, const Endpoint&) = default;
};

// Consecutive ranks form groups, each with a level-1 coordinator on its first rank. Consecutive
// groups form larger groups, each with a level-2 coordinator on its first rank, and so on up to the
// top coordinator on rank 0. Immutable: any thread may read it.
class Hierarchy {
 public:
  // Chooses the smallest number of levels with at most `max_children` children per coordinator, and
  // for this number of levels the smallest number of children, at least 2. `ranks` >= 1,
  // `max_children` >= 2.
  Hierarchy(int ranks, std::int64_t max_children);

  int ranks() const { return ranks_; }
  // Number of coordinator levels, >= 1.
  int levels() const { return static_cast<int>(strides_.size()) - 1; }
  Endpoint top() const { return {0, levels()}; }
  // The highest level of a coordinator on `rank`; 0 if it has none.
  int highest_at(int rank) const;

  // The parent of `post`, which must not be the top.
  Endpoint parent(Endpoint post) const;
  // The number of children of the coordinator at `post`.
  int children(Endpoint post) const;
  Endpoint child(Endpoint post, int number) const;
  // The number of the child of `post` that is `rank` or has `rank` below it. `rank` must be below
  // `post`.
  int child_with(Endpoint post, int rank) const;
  bool is_below(Endpoint post, int rank) const;

 private:
  bool is_partition() const;

  int ranks_;
  std::vector<int> strides_;  // by level: distance in ranks between neighbouring coordinators
};

}  // namespace grove::detail
