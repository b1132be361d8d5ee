// SPDX-License-Identifier: MIT
// Stages of one agent over late costs, for a search that plain distances mislead.
#pragma once

#include <optional>

#include "planning/safe_intervals.h"
#include "planning/sequence_stages.h"

namespace grove::detail {

class LateGoals {
 public:
  // Both must outlive this.
  LateGoals(const World& world, SafeIntervals& intervals) : world_(world), intervals_(intervals) {}

  // The stages of the same class over late costs (late_costs.h). Returns nullptr unless these prove
  // a higher cost of the best sequence; a limit may prevent that. Valid until the next call.
  SequenceStages* over(SequenceStages& plain, const Limits& limits);

 private:
  const World& world_;
  SafeIntervals& intervals_;
  std::optional<CostToGo> completions_;
  AgentIndex agent_ = 0;                 // their agent,
  SequenceClass class_;                  // and their class
  std::optional<SequenceStages> goals_;  // over completions_
};

}  // namespace grove::detail
