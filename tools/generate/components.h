// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "model/grid.h"
#include "model/roadmap.h"

namespace grove::detail {

// Returns, for each cell, the index of its connected component of passable cells; -1 for blocked
// cells. Indices start at 0, in the order of the first cells of the components.
std::vector<int> components(const Grid& grid);

// Returns the cells of the largest component in ascending order (the first component of several
// equally large ones). Returns an empty vector if all cells are blocked.
std::vector<Cell> largest_component(const Grid& grid);

// Returns the vertices of the largest strongly connected component in ascending order. If several
// are equally large, returns the one that contains the least vertex.
std::vector<int> largest_strong_component(const Roadmap& roadmap);

}  // namespace grove::detail
