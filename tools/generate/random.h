// SPDX-License-Identifier: MIT
// Where the generators have their random numbers from.
#pragma once

#include <cstdint>

#include "model/random.h"

namespace grove::detail {

// What the numbers of a seed are for: different uses of one seed do not depend on each other.
enum class RandomUse : std::uint32_t {
  kMap = 1,
  kScenario = 2,  // starts, goals and places of tasks
  kTasks = 3,     // whose they are
  kRoadmap = 4,
  kMotion = 5,  // headings
  kDurations = 6
};

inline Random random_for(RandomUse use, std::uint64_t seed) {
  return Random(seed, static_cast<std::uint32_t>(use));
}

}  // namespace grove::detail
