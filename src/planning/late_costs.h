// SPDX-License-Identifier: MIT
// Late costs: lower bounds on legs that take into account the times from which places are barred
// forever. (The *plain* costs ignore constraints.) Also the stages of an agent over these costs.
#pragma once

#include <optional>

#include "planning/safe_intervals.h"
#include "planning/sequence_stages.h"
#include "sequencing/cost_matrix.h"

namespace grove::detail {

// Returns lower bounds on the legs of every path under `intervals` that visits the stops in the
// order of a sequence whose plain cost is at least `min_cost`. Returns nullopt if no entry
// exceeds that of the plain matrix. O(stops * states).
std::optional<CostMatrix> late_cost_matrix(const World& world, SafeIntervals& intervals,
                                           const AgentStops& stops, Time min_cost);

// Stages of one agent over late costs, for searches in which plain distances are far below the
// actual costs. One thread at a time.
class LateStages {
 public:
  // `world` and `intervals` must outlive this object.
  LateStages(const World& world, SafeIntervals& intervals) : world_(world), intervals_(intervals) {}

  // Returns the stages of the class of `plain` over late costs. Returns nullptr if they do not
  // prove a higher cost of the best sequence, for instance because a limit was reached. The result
  // refers to plain.stops() and is valid until the next call.
  SequenceStages* with_late_costs(SequenceStages& plain, const Limits& limits);

 private:
  const World& world_;
  SafeIntervals& intervals_;
  std::optional<CostToGo> cost_to_go_;
  AgentIndex agent_ = 0;                 // agent of cost_to_go_
  SequenceClass class_;                  // sequence class of cost_to_go_
  std::optional<SequenceStages> goals_;  // over cost_to_go_
};

}  // namespace grove::detail
