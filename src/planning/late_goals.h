// SPDX-License-Identifier: MIT
// One agent's goals over legs priced anew, for a search that plain distances mislead.
#pragma once

#include <optional>

#include "planning/safe_intervals.h"
#include "planning/sequence_stages.h"

namespace grove::detail {

class LateGoals {
 public:
  // Both must outlive this.
  LateGoals(const World& world, SafeIntervals& intervals) : world_(world), intervals_(intervals) {}

  // The same class over completions by late costs (late_costs.h), if its best sequence costs more
  // by these; null: it does not, or a limit struck. Until the next call.
  SequenceStages* over(SequenceStages& plain, const Limits& limits);

 private:
  const World& world_;
  SafeIntervals& intervals_;
  std::optional<CostToGo> completions_;
  AgentIndex agent_ = 0;                 // whose they are,
  SequenceClass class_;                  // and of which class
  std::optional<SequenceStages> goals_;  // over these
};

}  // namespace grove::detail
