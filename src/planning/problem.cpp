// SPDX-License-Identifier: MIT
#include "planning/problem.h"

#include "sequencing/cost_to_go.h"

namespace grove::detail {

ArrayLayout array_layout(const Instance& instance) {
  const auto states = static_cast<std::size_t>(instance.world().state_count());
  ArrayLayout layout;
  const auto arrays = [&](ArrayKind kind) -> std::vector<std::size_t>& {
    return layout[static_cast<std::size_t>(kind)];
  };
  arrays(ArrayKind::kDistances) = DistanceFields::layout_of(instance);
  for (const Agent& agent : instance.agents()) {
    arrays(ArrayKind::kStopsOfStates).push_back(states);
    const int ports = agent.kind > 0 ? DistanceFields::kPorts : 1;
    arrays(ArrayKind::kSequenceTable)
        .push_back(CostToGo::table_bytes(static_cast<int>(agent.stops.size()), ports));
  }
  return layout;
}

}  // namespace grove::detail
