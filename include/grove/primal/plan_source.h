// SPDX-License-Identifier: MIT
// Where plans come from.
#pragma once

#include <cstdint>

namespace grove {

enum class PlanSource : std::uint8_t {
  kTree,            // a conflict-free constraint-tree node
  kStart,           // given with the instance
  kPriorities,      // prioritised planning
  kConfigurations,  // configuration search
  kNeighborhood,    // large neighbourhood search
};
inline constexpr PlanSource kLastPlanSource = PlanSource::kNeighborhood;

}  // namespace grove
