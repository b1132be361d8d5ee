// SPDX-License-Identifier: MIT
// Random tiny maps with shapes that are difficult for the search.
#pragma once

#include <string>
#include <vector>

#include "tests/fuzz/random.h"

namespace grove::detail::fuzz {

enum class Shape {
  kOpen,       // no obstacles
  kObstacles,  // random obstacles
  kCorridor,   // one cell wide
  kBays,       // a corridor with places to step aside
  kDeadEnds,   // a corridor with side branches up to two deep
  kRooms,      // two rooms and a door
  kTree,       // no cycles
  kRing,       // one cycle, possibly with a bay
  kTwoParts,   // two open parts separated by a wall
};
inline constexpr int kShapeCount = 9;

// Returns rows of '.' (passable) and '@' (blocked) with 4 to 14 passable cells.
std::vector<std::string> random_map(Shape shape, Random& random);

// Returns the number of passable cells among the four neighbours of a cell.
int passable_around(const std::vector<std::string>& rows, int x, int y);

}  // namespace grove::detail::fuzz
