// SPDX-License-Identifier: MIT
// Which ranks solve an instance together.
#pragma once

namespace grove::detail::batch {

// The ranks of the world in groups of `per_group` consecutive ones; the last may be smaller. The
// first of each leads. Both numbers at least 1.
struct Grouping {
  int ranks = 1;
  int per_group = 1;

  int groups() const { return (ranks + per_group - 1) / per_group; }
  int group_of(int rank) const { return rank / per_group; }
  int rank_in_group(int rank) const { return rank % per_group; }
};

}  // namespace grove::detail::batch
