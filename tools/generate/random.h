// SPDX-License-Identifier: MIT
// Random number generators for generated instances.
#pragma once

#include <cstdint>

#include "model/random.h"

namespace grove::detail {

// Purpose of random numbers. One seed gives an independent sequence for each purpose.
enum class RandomUse : std::uint32_t {
  kMap = 1,
  kScenario = 2,  // starts, goals and places of tasks
  kTasks = 3,     // assignment of tasks
  kRoadmap = 4,
  kMotion = 5,  // headings
  kDurations = 6,
  kNeeds = 7,  // which tasks have a need, and their agents
  kGoals = 8   // choices of destinations
};

inline Random random_for(RandomUse use, std::uint64_t seed) {
  return Random(seed, static_cast<std::uint32_t>(use));
}

}  // namespace grove::detail
