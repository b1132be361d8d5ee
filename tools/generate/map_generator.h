// SPDX-License-Identifier: MIT
// Generated maps, always with one connected component of passable cells. All throw
// std::invalid_argument if the numbers contradict each other; width and height must be positive.
#pragma once

#include <cstdint>

#include "model/grid.h"

namespace grove::detail {

Grid empty_map(int width, int height);

// Blocks exactly the share `obstacles` (0 to 1, rounded to whole cells) at random.
Grid random_map(int width, int height, double obstacles, std::uint64_t seed);

// Makes square rooms with a side of `room_size` cells, separated by walls of one cell; rooms at the
// right and bottom edge may be smaller, or one cell larger. A wall between two rooms has at most
// one door of one cell: the share `doors` (0 to 1) of the walls has one, and at least those that
// are needed to connect all rooms.
Grid rooms_map(int width, int height, int room_size, double doors, std::uint64_t seed);

}  // namespace grove::detail
