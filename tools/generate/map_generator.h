// SPDX-License-Identifier: MIT
// Maps of our own making. Passable cells are always one connected part. All throw
// std::invalid_argument when the numbers do not fit together; width and height must be positive.
#pragma once

#include <cstdint>

#include "model/grid.h"

namespace grove::detail {

Grid empty_map(int width, int height);

// Exactly the share `obstacles` (0 .. 1, rounded to whole cells) is blocked, at random.
Grid random_map(int width, int height, double obstacles, std::uint64_t seed);

// Square rooms of `room_size` cells a side - those at the right and bottom edge may be smaller or
// one larger - with walls of one cell between them. A wall between two rooms has one door of one
// cell or none: the share `doors` (0 .. 1) of them has one, and at least those that connect all
// rooms.
Grid rooms_map(int width, int height, int room_size, double doors, std::uint64_t seed);

}  // namespace grove::detail
