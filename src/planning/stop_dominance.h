// SPDX-License-Identifier: MIT
// Which labels of goals_in_class.h may wait, or are not needed at all, since one that was
// expanded on a stop stands for them.
#pragma once

#include <cstdint>
#include <vector>

#include "model/plan.h"
#include "planning/sequence_stages.h"

namespace grove::detail {

// The gates of one search, by state and onward way (SequenceStages::onward). What a gate is, and
// why it loses no path: gates.cpp.
class StopDominance {
 public:
  using StageId = SequenceStages::StageId;

  // Opens all.
  void begin_search();

  // A label in the stage after `from` was expanded in `state`, on a stop just counted at `time`.
  // Whoever comes to that stop earlier than `until` could be where it is; kNever: whoever comes at
  // all.
  void close(const SequenceStages& goals, StageId from, State state, Time time, Time until);

  // Is any way on from this state closed?
  bool any(StageId stage) const {
    return static_cast<std::size_t>(stage) < by_stage_.size() && by_stage_[stage] != kNone;
  }
  // What a path from here on costs that is of use: the least f of the ways on, each with the visit
  // of its stop put off as its gate says; kNever or more: none is. There must be any().
  Time least_cost(const SequenceStages& goals, StageId stage, State state, Time time) const;

 private:
  // A label that reaches the stop at `from` or later need not be looked at for the sake of this
  // way, unless the stop is visited at `until` or later.
  struct GlobalBounds {
    Time from = kNever;
    Time until = 0;
  };
  static constexpr std::int32_t kNone = -1;

  std::vector<std::int32_t> by_stage_;  // the first of its gates
  std::vector<StageId> stages_;         // those that have gates
  std::vector<GlobalBounds> gates_;
};

}  // namespace grove::detail
