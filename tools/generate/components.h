// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "model/grid.h"
#include "model/roadmap.h"

namespace grove::detail {

// The connected parts of the passable cells: by cell, the number of its part (from 0, in the order
// of their first cells), or -1 on blocked cells.
std::vector<int> components(const Grid& grid);

// The cells of the largest part (the first of several), in ascending order; empty if all is
// blocked.
std::vector<Cell> largest_component(const Grid& grid);

// The vertices of the largest part (the first of several) in which every vertex can be reached from
// every other, in ascending order.
std::vector<int> largest_strong_component(const Roadmap& roadmap);

}  // namespace grove::detail
