// SPDX-License-Identifier: MIT
#include "baselines/low_level.h"

#include <stdexcept>

#include "baselines/space_time_legs.h"
#include "baselines/time_interval_forest.h"
#include "baselines/visited_set_search.h"
#include "baselines/visiting_order_search.h"
#include "planning/free_order_sipp.h"

namespace grove::detail {

std::unique_ptr<AgentPlanner> make_agent_planner(LowLevel low_level, const World& world) {
  switch (low_level) {
    case LowLevel::kOwn:
      return std::make_unique<FreeOrderSipp>(world);
    case LowLevel::kVisitedSets:
      return std::make_unique<VisitedSetSearch>(world);
    case LowLevel::kSingleLegs:
      return std::make_unique<VisitingOrderSearch>(world, std::make_unique<SpaceTimeLegs>(world));
    case LowLevel::kTimeIntervalForest:
      return std::make_unique<VisitingOrderSearch>(world,
                                                   std::make_unique<TimeIntervalForest>(world));
  }
  throw std::invalid_argument("unknown low level");
}

}  // namespace grove::detail
