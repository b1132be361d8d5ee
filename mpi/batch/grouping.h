// SPDX-License-Identifier: MIT
// Assignment of ranks to groups that solve an instance together.
#pragma once

namespace grove::detail::batch {

// Partitions the ranks of the world into groups of `per_group` consecutive ranks; the last group
// may be smaller. The first rank of each group is its leader. Both numbers are >= 1.
struct Grouping {
  int ranks = 1;
  int per_group = 1;

  int groups() const { return (ranks + per_group - 1) / per_group; }
  int group_of(int rank) const { return rank / per_group; }
  int rank_in_group(int rank) const { return rank % per_group; }
};

}  // namespace grove::detail::batch
