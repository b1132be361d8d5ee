// SPDX-License-Identifier: MIT
// Random errands that arrive over time.
#pragma once

#include <cstdint>
#include <grove/grove.hpp>
#include <vector>

namespace lifelong {

// One robot must visit the cell, at time step `arrives` or later.
struct Errand {
  int id = 0;
  int arrives = 0;
  grove::Cell cell = {};
};

// Returns `count` errands on passable cells, in order of arrival. Arrival times are uniformly
// random below `steps`. The same seed gives the same errands.
std::vector<Errand> random_errands(const grove::World& world, int count, int steps,
                                   std::uint64_t seed);
// Returns `robots` distinct passable cells as starts, or all passable cells if there are fewer.
std::vector<grove::Cell> random_starts(const grove::World& world, int robots, std::uint64_t seed);

}  // namespace lifelong
