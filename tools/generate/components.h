// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "model/grid.h"
#include "model/roadmap.h"

namespace grove::detail {

// Returns for each cell the number of its connected component of passable cells, from 0 in the
// order of the components' first cells; -1 for blocked cells.
std::vector<int> components(const Grid& grid);

// Returns the cells of the largest component (the first of several) in ascending order. Empty if
// all cells are blocked.
std::vector<Cell> largest_component(const Grid& grid);

// Returns the vertices of the largest strongly connected component (the first of several) in
// ascending order.
std::vector<int> largest_strong_component(const Roadmap& roadmap);

}  // namespace grove::detail
