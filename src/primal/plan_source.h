// SPDX-License-Identifier: MIT
// Source of a plan: the search or input that it comes from.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace grove::detail {

enum class PlanSource : std::uint8_t {
  kTree,                 // a conflict-free constraint-tree node
  kStart,                // start plan, or incumbent from a checkpoint
  kPrioritizedPlanning,  // prioritised planning
  kLacam,                // LaCAM
  kLns,                  // large neighbourhood search
  kJointSearch,          // A* over joint states
  kCores,                // core-guided search
};
inline constexpr PlanSource kLastPlanSource = PlanSource::kCores;
inline constexpr std::array<std::string_view, 7> kPlanSources{
    "tree", "start", "prioritized", "lacam", "lns", "joint", "cores"};
static_assert(kPlanSources.size() == static_cast<std::size_t>(kLastPlanSource) + 1);

// The name of a source in files and logs.
constexpr std::string_view name_of(PlanSource source) {
  return kPlanSources[static_cast<std::size_t>(source)];
}

}  // namespace grove::detail
