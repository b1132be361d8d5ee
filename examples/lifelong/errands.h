// SPDX-License-Identifier: MIT
// What robots are asked to do, as time goes on.
#pragma once

#include <cstdint>
#include <grove/grove.hpp>
#include <vector>

namespace lifelong {

// A robot has to be on the cell once, at step `arrives` or later.
struct Errand {
  int id = 0;
  int arrives = 0;
  grove::Cell cell = {};
};

// `count` errands on passable cells, spread evenly at random over `steps`, in order of time; the
// same seed makes the same ones.
std::vector<Errand> random_errands(const grove::World& world, int count, int steps,
                                   std::uint64_t seed);
// Distinct passable cells for robots to start on; fewer than `robots` if there are no more.
std::vector<grove::Cell> random_starts(const grove::World& world, int robots, std::uint64_t seed);

}  // namespace lifelong
