// SPDX-License-Identifier: MIT
// A quick necessary condition for a path through many cells.
#pragma once

#include <span>
#include <vector>

#include "grove/planning/bucket_queue.h"
#include "grove/planning/safe_intervals.h"

namespace grove {

// When can the agent come to rest, having been on one given cell? What it must visit besides only
// makes it later: so each stop of an agent bounds its cost. Polynomial where the question for all
// stops together is not: it settles the common hopeless case, a door shut before or behind the
// agent, for ever or for long.
class VisitCheck {
 public:
  VisitCheck(const Grid& grid, SafeIntervals& intervals) : grid_(grid), intervals_(intervals) {}

  // The first time at which an agent that starts on `start` can rest on one of `rests` for ever,
  // having been on `via`; kNever: it cannot at all.
  Time first_rest(Cell start, Cell via, std::span<const Cell> rests);

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
