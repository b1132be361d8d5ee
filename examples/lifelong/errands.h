// SPDX-License-Identifier: MIT
// What robots are asked to do, as time goes on.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "grove/detail/model/grid.h"

namespace grove::detail::lifelong {

// A robot has to be on the cell once, from then on.
struct Errand {
  int id = 0;
  Time arrives = 0;
  Cell cell = kNoCell;
};

// So many errands on passable cells, spread evenly at random over `steps`, in order of time; the
// same seed makes the same ones.
std::vector<Errand> random_errands(const Grid& grid, int count, Time steps, std::uint64_t seed);
// Distinct passable cells for robots to start on.
std::vector<Cell> random_starts(const Grid& grid, int robots, std::uint64_t seed);

}  // namespace grove::detail::lifelong
