// SPDX-License-Identifier: MIT
// One agent's sequences from the cheapest on (paper, Algorithm 2), computed as far as asked for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "sequencing/rtsp.h"

namespace grove::detail {

// The list of all complete sequences of one agent by cost. Rank 0 is the best. Not for two threads
// at once. After an exception (std::bad_alloc) its bounds are no longer valid: give it up.
class KBestSequences {
 public:
  // `matrix`, which the solver was made for, and `limits` must outlive the list.
  KBestSequences(std::unique_ptr<RtspSolver> solver, const CostMatrix& matrix,
                 const Limits& limits);
  ~KBestSequences();
  KBestSequences(KBestSequences&&) noexcept;
  KBestSequences& operator=(KBestSequences&&) noexcept;

  // A proven lower bound on the cost of the sequence of this rank, from what is known already;
  // kNever when there are proven to be no more than are known. Non-decreasing in rank; of all ranks
  // not known it is that of the first of them.
  Time cost_bound(std::size_t rank) const;
  // Is the sequence of this rank computed? Then cost_bound is its cost.
  bool known(std::size_t rank) const;
  // Works until `rank` is known, or its cost is proven to exceed `cutoff` (kNever: none), or it is
  // proven not to exist, or a limit strikes. Returns cost_bound(rank).
  Time resolve(std::size_t rank, Time cutoff);
  // The sequence of a known rank; stays where it is as long as the list lives.
  const Sequence& sequence(std::size_t rank);

  // rTSPs solved so far.
  std::int64_t rtsp_calls() const;

 private:
  class Partition;
  std::unique_ptr<Partition> partition_;
};

}  // namespace grove::detail
