// SPDX-License-Identifier: MIT
// K best sequences of one agent (paper, Algorithm 2), computed lazily.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "sequencing/rtsp.h"

namespace grove::detail {

// The list of all complete sequences of one agent in ascending order of cost, from rank 0. One
// thread at a time. Discard the list if a method throws, because its bounds are then not valid.
class KBestSequences {
 public:
  // `solver` must have been made for `matrix`. `matrix` and `limits` must outlive the list.
  KBestSequences(std::unique_ptr<RtspSolver> solver, const CostMatrix& matrix,
                 const Limits& limits);
  ~KBestSequences();
  KBestSequences(KBestSequences&&) noexcept;
  KBestSequences& operator=(KBestSequences&&) noexcept;

  // Returns a proven lower bound on the cost of the sequence of this rank, without further search.
  // kNever: proven that no such sequence exists. Non-decreasing in rank; all unknown ranks have the
  // same bound.
  Time cost_bound(std::size_t rank) const;
  // True if the sequence of this rank is computed; cost_bound() is then its cost.
  bool known(std::size_t rank) const;
  // Searches until `rank` is known, its cost is proven to exceed `cutoff` (kNever: no cutoff), it
  // is proven that no such sequence exists, or a limit is reached or the solver stops
  // (RtspAnswer::kStopped). Returns cost_bound(rank).
  Time resolve(std::size_t rank, Time cutoff);
  // Returns the sequence of a known rank. The reference is valid as long as the list lives.
  const Sequence& sequence(std::size_t rank);

  // Number of calls of the solver so far.
  std::int64_t rtsp_calls() const;

 private:
  class Partition;
  std::unique_ptr<Partition> partition_;
};

}  // namespace grove::detail
