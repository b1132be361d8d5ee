// SPDX-License-Identifier: MIT
#include "lagrangian/least_cost.h"

namespace grove::detail {

Time least_cost(FreeGoals& goals, const Limits& limits) {
  Completions& completions = goals.completions();
  for (;;) {
    const FreeGoals::StageId stage = goals.first_stage();
    const Time beyond = completions.beyond();
    if (stage != FreeGoals::kOutside) {
      const Time distance = goals.distance(stage, goals.stops().start());
      if (distance < beyond) return distance;
    }
    if (beyond >= kNever || !completions.widen(beyond, limits)) return beyond;
  }
}

}  // namespace grove::detail
