// SPDX-License-Identifier: MIT
#include "grove/baselines/baseline_search.h"

#include <algorithm>
#include <stdexcept>

#include "space_time_legs.h"
#include "time_interval_forest.h"
#include "visited_set_search.h"
#include "visiting_order_search.h"

namespace grove {

BaselineSearch::Outcome BaselineSearch::find(AgentIndex agent, const AgentStops& stops,
                                             std::span<const Constraint> constraints, Time cutoff,
                                             const Limits& limits, Path& path) {
  if (!std::ranges::all_of(constraints,
                           [](const Constraint& c) { return c.kind == ConstraintKind::kBar; }))
    throw std::invalid_argument("the low levels of other methods know no constraints but bars");
  if (limits.stop_requested()) return Outcome::kStopped;
  return search(agent, stops, constraints, cutoff, limits, path);
}

std::unique_ptr<BaselineSearch> make_baseline_search(LowLevel low_level, const Grid& grid) {
  switch (low_level) {
    case LowLevel::kVisitedSets:
      return std::make_unique<VisitedSetSearch>(grid);
    case LowLevel::kSingleLegs:
      return std::make_unique<VisitingOrderSearch>(grid, std::make_unique<SpaceTimeLegs>(grid));
    case LowLevel::kTimeIntervalForest:
      return std::make_unique<VisitingOrderSearch>(grid,
                                                   std::make_unique<TimeIntervalForest>(grid));
    case LowLevel::kOwn:
      break;
  }
  return nullptr;
}

}  // namespace grove
