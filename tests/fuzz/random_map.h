// SPDX-License-Identifier: MIT
// Tiny maps of the shapes that hurt.
#pragma once

#include <string>
#include <vector>

#include "tests/fuzz/random.h"

namespace grove::detail::fuzz {

enum class Shape {
  kOpen,       // no obstacle
  kObstacles,  // some, anywhere
  kCorridor,   // one cell wide
  kBays,       // a corridor with places to step aside
  kDeadEnds,   // a corridor with side branches two deep
  kRooms,      // two rooms and a door
  kTree,       // no way round anything
  kRing,       // one way round, perhaps with a bay
  kTwoParts,   // two of the above, unconnected
};
inline constexpr int kShapeCount = 9;

// Rows of '.' and '@'; 4 to 14 passable cells.
std::vector<std::string> random_map(Shape shape, Random& random);

// How many of the four neighbours of a cell are passable.
int passable_around(const std::vector<std::string>& rows, int x, int y);

}  // namespace grove::detail::fuzz
