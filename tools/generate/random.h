// SPDX-License-Identifier: MIT
// Random numbers of the generators.
#pragma once

#include <cstdint>

#include "model/random.h"

namespace grove::detail {

// Use of the numbers of a seed; different uses of one seed are independent.
enum class RandomUse : std::uint32_t {
  kMap = 1,
  kScenario = 2,  // starts, goals and places of tasks
  kTasks = 3,     // assignment of tasks
  kRoadmap = 4,
  kMotion = 5,  // headings
  kDurations = 6
};

inline Random random_for(RandomUse use, std::uint64_t seed) {
  return Random(seed, static_cast<std::uint32_t>(use));
}

}  // namespace grove::detail
