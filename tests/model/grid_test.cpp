// SPDX-License-Identifier: MIT
#include "model/grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

namespace grove::detail {
namespace grid_test {

TEST(Grid, NumbersCellsRowByRowFromTheTopLeft) {
  const Grid grid(3, 2, std::vector<bool>(6, true));
  EXPECT_EQ(grid.cell({2, 1}), 5);
  EXPECT_EQ(grid.position(5), (Position{2, 1}));
  EXPECT_EQ(grid.cell_count(), 6);
}

TEST(Grid, NeighborsArePassableAndOneMoveAway) {
  // . @ .
  // . . .
  const Grid grid(3, 2, {true, false, true, true, true, true});
  const auto neighbors = [&](Cell c) {
    std::vector<Cell> cells(grid.neighbors(c).begin(), grid.neighbors(c).end());
    std::ranges::sort(cells);
    return cells;
  };
  EXPECT_EQ(neighbors(0), std::vector<Cell>({3}));
  EXPECT_EQ(neighbors(1), std::vector<Cell>());  // blocked
  EXPECT_EQ(neighbors(3), std::vector<Cell>({0, 4}));
  EXPECT_EQ(neighbors(4), std::vector<Cell>({3, 5}));
  EXPECT_EQ(grid.passable_count(), 5);
}

TEST(Grid, DoesNotWrapAroundAtTheEdges) {
  const Grid grid(2, 2, std::vector<bool>(4, true));
  EXPECT_EQ(std::ranges::count(grid.neighbors(1), Cell{2}), 0);
}

TEST(Grid, RefusesSizesThatDoNotFit) {
  EXPECT_THROW(Grid(0, 1, {}), std::invalid_argument);
  EXPECT_THROW(Grid(2, 2, std::vector<bool>(3, true)), std::invalid_argument);
  EXPECT_THROW(Grid(1 << 20, 1 << 20, {}), std::invalid_argument);
}

}  // namespace grid_test
}  // namespace grove::detail
