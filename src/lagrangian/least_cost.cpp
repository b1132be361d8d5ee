// SPDX-License-Identifier: MIT
#include "lagrangian/least_cost.h"

namespace grove::detail {

Time least_cost(SequenceStages& goals, const Limits& limits) {
  CostToGo& cost_to_go = goals.cost_to_go();
  for (;;) {
    const SequenceStages::StageId stage = goals.first_stage();
    const Time beyond = cost_to_go.beyond();
    if (stage != SequenceStages::kOutside) {
      const Time distance = goals.distance(stage, goals.stops().start());
      if (distance < beyond) return distance;
    }
    if (beyond >= kNever || !cost_to_go.widen(beyond, limits)) return beyond;
  }
}

}  // namespace grove::detail
