// SPDX-License-Identifier: MIT
// Cost matrix that takes into account from when on places are barred for ever, and stages over it.
#pragma once

#include <optional>

#include "planning/safe_intervals.h"
#include "planning/sequence_stages.h"
#include "sequencing/cost_matrix.h"

namespace grove::detail {

// Lower bounds on the legs of every path under these intervals that visits the stops in the order
// of a sequence of plain cost `min_cost` or more. Returns nullopt if no entry exceeds the plain
// matrix. O(stops * states).
std::optional<CostMatrix> late_cost_matrix(const World& world, SafeIntervals& intervals,
                                           const AgentStops& stops, Time min_cost);

// Stages of one agent over late costs, for a search that plain distances mislead.
class LateStages {
 public:
  // Both must outlive this.
  LateStages(const World& world, SafeIntervals& intervals) : world_(world), intervals_(intervals) {}

  // The stages of the same class over late costs. Returns nullptr unless these prove a higher cost
  // of the best sequence; a limit may prevent that. Valid until the next call.
  SequenceStages* over(SequenceStages& plain, const Limits& limits);

 private:
  const World& world_;
  SafeIntervals& intervals_;
  std::optional<CostToGo> cost_to_go_;
  AgentIndex agent_ = 0;                 // their agent,
  SequenceClass class_;                  // and their class
  std::optional<SequenceStages> goals_;  // over cost_to_go_
};

}  // namespace grove::detail
