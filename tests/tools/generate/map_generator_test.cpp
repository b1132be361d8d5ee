// SPDX-License-Identifier: MIT
#include "tools/generate/map_generator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>

#include "tools/generate/components.h"

namespace grove::detail {
namespace map_generator_test {

std::string text(const Grid& grid) {
  std::string text;
  for (Cell cell = 0; cell < grid.cell_count(); ++cell) {
    text += grid.passable(cell) ? '.' : '@';
    if (grid.position(cell).x == grid.width() - 1) text += '\n';
  }
  return text;
}

bool is_connected(const Grid& grid) {
  return largest_component(grid).size() == static_cast<std::size_t>(grid.passable_count());
}

TEST(EmptyMap, HasNoObstacles) {
  EXPECT_EQ(text(empty_map(3, 2)), "...\n...\n");
}

TEST(RandomMap, BlocksTheExactShareAndStaysConnected) {
  for (double share : {0.0, 0.1, 0.2, 0.4, 0.6, 0.9}) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      const Grid grid = random_map(17, 11, share, seed);
      EXPECT_EQ(grid.cell_count() - grid.passable_count(), std::lround(share * 17 * 11));
      EXPECT_TRUE(is_connected(grid)) << text(grid);
    }
  }
}

TEST(RandomMap, DependsOnlyOnTheSeed) {
  EXPECT_EQ(text(random_map(9, 9, 0.3, 5)), text(random_map(9, 9, 0.3, 5)));
  EXPECT_NE(text(random_map(9, 9, 0.3, 5)), text(random_map(9, 9, 0.3, 6)));
}

TEST(RandomMap, RefusesToBlockEverything) {
  EXPECT_THROW(random_map(3, 3, 0.9, 0), std::invalid_argument);
  EXPECT_THROW(random_map(1, 1, 0, 0), std::invalid_argument);
}

TEST(RoomsMap, IsConnectedWithAnyDoors) {
  for (double doors : {0.0, 0.5, 1.0}) {
    for (int size : {1, 2, 3, 7, 31, 40}) {
      for (std::uint64_t seed = 0; seed < 5; ++seed)
        EXPECT_TRUE(is_connected(rooms_map(32, 19, size, doors, seed)));
    }
  }
}

// The doors are the passable cells outside the rooms.
TEST(RoomsMap, HasTheRequestedNumberOfDoors) {
  constexpr int kRooms = 4 * 4 * 3 * 3;  // 4 x 4 rooms of 3 x 3 cells; 24 walls between two rooms
  EXPECT_EQ(rooms_map(15, 15, 3, 0, 1).passable_count(), kRooms + 15);
  EXPECT_EQ(rooms_map(15, 15, 3, 0.75, 1).passable_count(), kRooms + 18);
  EXPECT_EQ(rooms_map(15, 15, 3, 1, 1).passable_count(), kRooms + 24);
}

TEST(RoomsMap, HasNoWallAtTheEdge) {
  EXPECT_EQ(text(rooms_map(4, 1, 3, 1, 0)), "....\n");
  EXPECT_EQ(text(rooms_map(5, 1, 3, 1, 0)), ".....\n");  // the only cell of the wall is its door
}

}  // namespace map_generator_test
}  // namespace grove::detail
