// SPDX-License-Identifier: MIT
// Random errands that arrive over time.
#pragma once

#include <cstdint>
#include <grove/grove.hpp>
#include <vector>

namespace lifelong {

// A robot must visit the cell once, at step `arrives` or later.
struct Errand {
  int id = 0;
  int arrives = 0;
  grove::Cell cell = {};
};

// Returns `count` errands on passable cells, at uniformly random times below `steps`, in order of
// time. The same seed gives the same errands.
std::vector<Errand> random_errands(const grove::World& world, int count, int steps,
                                   std::uint64_t seed);
// Returns distinct passable cells as starts; fewer than `robots` if there are not enough cells.
std::vector<grove::Cell> random_starts(const grove::World& world, int robots, std::uint64_t seed);

}  // namespace lifelong
