// SPDX-License-Identifier: MIT
// Generates maps. The passable cells of each map form one connected component. Width and height
// must be positive. All functions throw std::invalid_argument if their arguments contradict each
// other.
#pragma once

#include <cstdint>

#include "model/grid.h"

namespace grove::detail {

Grid empty_map(int width, int height);

// Returns a map on which exactly the share `obstacles` of the cells (from 0 to 1, rounded to whole
// cells) is blocked at random.
Grid random_map(int width, int height, double obstacles, std::uint64_t seed);

// Returns a map of square rooms with a side of `room_size` cells, separated by walls one cell wide.
// Rooms at the right and bottom edge can be smaller, or one cell larger. A wall between two rooms
// has at most one door, of one cell. The share `doors` (from 0 to 1) of the walls has a door, or
// more if that is necessary to connect all rooms.
Grid rooms_map(int width, int height, int room_size, double doors, std::uint64_t seed);

}  // namespace grove::detail
