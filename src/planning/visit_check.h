// SPDX-License-Identifier: MIT
// A quick necessary condition for a path through many cells.
#pragma once

#include <span>
#include <vector>

#include "bucket_queue.h"
#include "safe_intervals.h"

namespace grove {

// Can the agent be on one cell at some time, and after that come to rest? Each stop of an agent
// must pass this, whatever the order. Polynomial where the question for all stops together is not:
// it settles the common infeasible case, a door shut before or behind the agent.
class VisitCheck {
 public:
  VisitCheck(const Grid& grid, SafeIntervals& intervals) : grid_(grid), intervals_(intervals) {}

  // From `start` at time 0 by way of `via` to one of `rests` in an interval where it may rest.
  bool can_visit(Cell start, Cell via, std::span<const Cell> rests);

 private:
  using Queue = BasicBucketQueue<std::uint8_t>;  // progress: has been on `via`

  void reach(int slot, Cell cell, Time time, bool visited);

  const Grid& grid_;
  SafeIntervals& intervals_;
  Queue queue_;
  std::vector<Time> earliest_;  // by slot, then progress
  Cell via_ = kNoCell;
};

}  // namespace grove
