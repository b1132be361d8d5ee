// SPDX-License-Identifier: MIT
#include "planning/corridors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/planning/single_agent.h"

namespace grove::detail {
namespace corridors_test {

using testing::grid_of;
using Cells = std::vector<Cell>;

Cells cells_of(const Corridors& corridors, int corridor) {
  const auto cells = corridors.places(corridor);
  return {cells.begin(), cells.end()};
}

TEST(Corridors, DoorIsACorridor) {
  const Corridors corridors(grid_of({"..@..", ".....", "..@.."}));
  const int door = corridors.corridor_of(7);
  ASSERT_NE(door, Corridors::kNoCorridor);
  EXPECT_EQ(corridors.position(7), 1);
  Cells cells = cells_of(corridors, door);
  std::ranges::sort(cells);
  EXPECT_EQ(cells, (Cells{6, 7, 8}));
  EXPECT_EQ(corridors.corridor_of(6), Corridors::kNoCorridor);
}

TEST(Corridors, CorridorExtendsToDeadEnds) {
  const Corridors corridors(grid_of({"......"}));
  ASSERT_EQ(corridors.count(), 1);
  Cells cells = cells_of(corridors, 0);
  if (cells.front() != 0) std::ranges::reverse(cells);
  EXPECT_EQ(cells, (Cells{0, 1, 2, 3, 4, 5}));
}

TEST(Corridors, IsolatedRingIsNoCorridor) {
  const Corridors corridors(grid_of({"...", ".@.", "..."}));
  EXPECT_EQ(corridors.count(), 0);
  EXPECT_EQ(corridors.corridor_of(1), Corridors::kNoCorridor);
}

TEST(Corridors, LoopBeginsAndEndsAtOneCell) {
  const Corridors corridors(grid_of({"...@", ".@.@", "....", "@@@."}));
  ASSERT_EQ(corridors.count(), 2);
  const auto loop = corridors.places(corridors.corridor_of(0));
  EXPECT_EQ(loop.size(), 9u);
  EXPECT_EQ(loop.front(), 10);
  EXPECT_EQ(loop.back(), 10);
}

// Tests the definition on random maps.
TEST(Corridors, AreMaximalRowsOfCellsWithTwoNeighbors) {
  std::mt19937 random(1);
  int corridors_seen = 0;
  for (int round = 0; round < 300; ++round) {
    std::vector<bool> passable(48);
    for (std::size_t i = 0; i < passable.size(); ++i) passable[i] = random() % 3 > 0;
    const Grid grid(8, 6, passable);
    const Corridors corridors(grid);
    Cells inner;
    for (int corridor = 0; corridor < corridors.count(); ++corridor) {
      const auto cells = corridors.places(corridor);
      ASSERT_GE(cells.size(), 3u);
      EXPECT_NE(grid.neighbors(cells.front()).size(), 2u);
      EXPECT_NE(grid.neighbors(cells.back()).size(), 2u);
      for (std::size_t i = 1; i < cells.size(); ++i)
        EXPECT_EQ(std::ranges::count(grid.neighbors(cells[i - 1]), cells[i]), 1);
      for (std::size_t i = 1; i + 1 < cells.size(); ++i) {
        EXPECT_EQ(corridors.corridor_of(cells[i]), corridor);
        EXPECT_EQ(corridors.position(cells[i]), static_cast<int>(i));
        inner.push_back(cells[i]);
      }
      ++corridors_seen;
    }
    std::ranges::sort(inner);
    EXPECT_EQ(std::ranges::adjacent_find(inner), inner.end());
    // All other cells with two neighbours lie on isolated rings: their neighbours have two
    // neighbours each, too.
    for (Cell cell = 0; cell < grid.cell_count(); ++cell) {
      if (std::ranges::binary_search(inner, cell)) continue;
      EXPECT_EQ(corridors.corridor_of(cell), Corridors::kNoCorridor);
      if (grid.neighbors(cell).size() != 2) continue;
      for (Cell next : grid.neighbors(cell)) {
        EXPECT_EQ(grid.neighbors(next).size(), 2u);
        EXPECT_EQ(corridors.corridor_of(next), Corridors::kNoCorridor);
      }
    }
  }
  EXPECT_GT(corridors_seen, 300);
}

}  // namespace corridors_test
}  // namespace grove::detail
