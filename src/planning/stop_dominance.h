// SPDX-License-Identifier: MIT
// Label dominance at stops, for free_order_goals.h: which labels may be postponed or dropped,
// because a label that was expanded on a stop dominates them.
#pragma once

#include <cstdint>
#include <vector>

#include "model/plan.h"
#include "planning/sequence_stages.h"

namespace grove::detail {

// The gates of one search, by stage and onward port (SequenceStages::onward). The definition of a
// gate, and the proof that it loses no path: stop_dominance.cpp.
class StopDominance {
 public:
  using StageId = SequenceStages::StageId;

  // Removes all gates.
  void begin_search();

  // Records that a label in the stage after `from` was expanded in `state`, on a stop just counted
  // at `time`. It dominates a label of `from` that comes to that stop at `time` or later (plus the
  // time to turn) and before `until`; kNever: no upper limit.
  void close(const SequenceStages& goals, StageId from, State state, Time time, Time until);

  // Is there a gate at any onward port of this stage?
  bool any(StageId stage) const {
    return static_cast<std::size_t>(stage) < by_stage_.size() && by_stage_[stage] != kNone;
  }
  // Lower bound on the cost of a useful path from here on: the least f of the onward ports, where
  // the visit of each stop is postponed as its gate says. kNever or more if no path is useful.
  // Requires any().
  Time min_cost(const SequenceStages& goals, StageId stage, State state, Time time) const;

 private:
  // A gate: a label that reaches the stop at `from` or later is not needed for this port, unless it
  // visits the stop at `until` or later.
  struct Gate {
    Time from = kNever;
    Time until = 0;
  };
  static constexpr std::int32_t kNone = -1;

  std::vector<std::int32_t> by_stage_;  // index in gates_ of the first gate of the stage
  std::vector<StageId> stages_;         // the stages that have gates
  std::vector<Gate> gates_;
};

}  // namespace grove::detail
