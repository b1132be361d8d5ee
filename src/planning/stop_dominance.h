// SPDX-License-Identifier: MIT
// Label dominance at stops, for free_order_goals.h: labels are postponed or dropped if labels that
// were expanded on stops dominate them.
#pragma once

#include <cstdint>
#include <vector>

#include "model/plan.h"
#include "planning/sequence_stages.h"

namespace grove::detail {

// The gates of one search, by stage and onward port (SequenceStages::onward). The head of
// stop_dominance.cpp defines gates and proves that they lose no optimal path. One thread at a time.
class StopDominance {
 public:
  using StageId = SequenceStages::StageId;

  // Removes all gates.
  void begin_search();

  // Records a gate: a label whose parent is in stage `from` was expanded in `state`, on a stop that
  // it has just counted at `time`. This label dominates labels of stage `from` that count this stop
  // at `time` plus the turning time or later, and before `until`; kNever: no upper limit.
  void close(const SequenceStages& goals, StageId from, State state, Time time, Time until);

  // Is there a gate at any onward port of this stage?
  bool any(StageId stage) const {
    return static_cast<std::size_t>(stage) < by_stage_.size() && by_stage_[stage] != kNone;
  }
  // Returns a lower bound on the cost of the useful paths through a label: the least f over the
  // onward ports, where the gate of a port can postpone the visit of its stop. kNever if no path is
  // useful. Requires any(stage).
  Time min_cost(const SequenceStages& goals, StageId stage, State state, Time time) const;

 private:
  // A label that reaches the port at `from` or later is not needed for this port, unless it visits
  // the stop at `until` or later.
  struct Gate {
    Time from = kNever;
    Time until = 0;
  };
  static constexpr std::int32_t kNone = -1;

  std::vector<std::int32_t> by_stage_;  // index in gates_ of the first gate of the stage
  std::vector<StageId> stages_;         // stages that have gates
  std::vector<Gate> gates_;
};

}  // namespace grove::detail
