// SPDX-License-Identifier: MIT
// K best sequences of one agent (paper, Algorithm 2), computed lazily.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "sequencing/rtsp.h"

namespace grove::detail {

// The list of all complete sequences of one agent in order of cost. Rank 0 is the best. One thread
// at a time. After an exception (std::bad_alloc) its bounds are no longer valid: discard it.
class KBestSequences {
 public:
  // `matrix`, for which the solver was made, and `limits` must outlive the list.
  KBestSequences(std::unique_ptr<RtspSolver> solver, const CostMatrix& matrix,
                 const Limits& limits);
  ~KBestSequences();
  KBestSequences(KBestSequences&&) noexcept;
  KBestSequences& operator=(KBestSequences&&) noexcept;

  // Returns a proven lower bound on the cost of the sequence of this rank, without new work.
  // kNever: proven that no such sequence exists. Non-decreasing in rank; all unknown ranks have the
  // bound of the first unknown one.
  Time cost_bound(std::size_t rank) const;
  // Whether the sequence of this rank is computed. Then cost_bound() is its cost.
  bool known(std::size_t rank) const;
  // Works until `rank` is known, or its cost is proven to exceed `cutoff` (kNever: no cutoff), or
  // it is proven not to exist, or a limit is reached. Returns cost_bound(rank).
  Time resolve(std::size_t rank, Time cutoff);
  // Returns the sequence of a known rank. The reference is valid as long as the list lives.
  const Sequence& sequence(std::size_t rank);

  // Number of rTSPs solved so far.
  std::int64_t rtsp_calls() const;

 private:
  class Partition;
  std::unique_ptr<Partition> partition_;
};

}  // namespace grove::detail
