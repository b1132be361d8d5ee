// SPDX-License-Identifier: MIT
#include "planning/conflict_avoidance_table.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/planning/random_cases.h"
#include "tests/planning/reference_search.h"
#include "tests/planning/single_agent.h"

namespace grove::detail {
namespace conflict_avoidance_table_test {

using testing::grid_of;
using testing::NaiveConflicts;

void expect_same_counts(const Grid& grid, const ConflictAvoidanceTable& table,
                        const NaiveConflicts& naive) {
  for (Cell cell = 0; cell < grid.cell_count(); ++cell) {
    int waiting = 0;
    for (Time t = 1; t < 20; ++t) {
      EXPECT_EQ(table.conflicts(cell, cell, t), naive.conflicts(cell, cell, t));
      for (Cell from : grid.neighbors(cell))
        EXPECT_EQ(table.conflicts(from, cell, t), naive.conflicts(from, cell, t));
      EXPECT_EQ(table.conflicts_of_resting(cell, t), naive.conflicts_of_resting(cell, t));
      if (t >= 4) waiting += naive.conflicts(cell, cell, t);
      EXPECT_EQ(table.conflicts_of_waiting(cell, 4, t), waiting);
    }
  }
}

TEST(ConflictAvoidanceTable, AgreesWithNaiveCounts) {
  std::mt19937 random(7);
  for (const Grid& grid : {grid_of({"...", ".@.", "..."}), grid_of({"....."}),
                           grid_of({".", ".", "."}), grid_of({"....", "...."})}) {
    ConflictAvoidanceTable table(grid);
    NaiveConflicts naive;
    for (int step = 0; step < 60; ++step) {
      const auto action = random() % 8;
      if (action == 0) {
        table.clear();
        naive.paths.clear();
      } else if (action < 3 && !naive.paths.empty()) {
        const auto victim = naive.paths.begin() + static_cast<int>(random() % naive.paths.size());
        table.remove(*victim);
        naive.paths.erase(victim);
      } else {
        naive.paths.push_back(testing::random_walk(grid, random, 14));
        table.add(naive.paths.back());
      }
      expect_same_counts(grid, table, naive);
    }
  }
}

// The counts of removed paths occupy memory until the table needs it and drops them. The test adds
// about three times as many paths as initially fit.
TEST(ConflictAvoidanceTable, AgreesAfterDroppingRemovedPaths) {
  std::mt19937 random(8);
  const Grid grid =
      grid_of({"........", "........", "........", "........", "........", "........"});
  for (const std::size_t max_paths : {2, 40}) {
    ConflictAvoidanceTable table(grid);
    NaiveConflicts naive;
    for (int step = 0; step < 80; ++step) {
      if (naive.paths.size() == max_paths) {
        table.remove(naive.paths.front());
        naive.paths.erase(naive.paths.begin());
      }
      naive.paths.push_back(testing::random_walk(grid, random, 18));
      table.add(naive.paths.back());
      if (step % 8 == 7) expect_same_counts(grid, table, naive);
    }
  }
}

TEST(ConflictAvoidanceTable, ClearRemovesPathsEvenAfterManyClears) {
  const Grid grid = grid_of({"...."});
  ConflictAvoidanceTable table(grid);
  for (int round = 0; round < 140'000; ++round) {
    if (round % 2 == 0) table.add({0, 1, 2});
    EXPECT_EQ(table.conflicts(1, 1, 1), round % 2 == 0 ? 1 : 0);
    EXPECT_EQ(table.conflicts(2, 1, 2), round % 2 == 0 ? 1 : 0);
    table.clear();
  }
}

TEST(ConflictAvoidanceTable, CountsVertexAndSwap) {
  const Grid grid = grid_of({"..."});
  ConflictAvoidanceTable table(grid);
  table.add({0, 1, 2});
  EXPECT_EQ(table.conflicts(1, 0, 1), 1);  // a swap conflict
  EXPECT_EQ(table.conflicts(1, 1, 1), 1);
  EXPECT_EQ(table.conflicts(0, 1, 1), 1);  // the same move as another agent: only a vertex conflict
  EXPECT_EQ(table.conflicts(1, 0, 2), 0);
}

TEST(ConflictAvoidanceTable, AgentsRestForever) {
  const Grid grid = grid_of({"..."});
  ConflictAvoidanceTable table(grid);
  table.add({0, 1});
  EXPECT_EQ(table.conflicts(2, 1, 1'000'000), 1);
  EXPECT_EQ(table.conflicts(1, 2, 1'000'000), 0);
  EXPECT_EQ(table.conflicts_of_waiting(1, 11, 1'000), 990);
}

TEST(ConflictAvoidanceTable, EmptyPathHasNoConflicts) {
  const Grid grid = grid_of({".."});
  ConflictAvoidanceTable table(grid);
  table.add({});
  table.remove({});
  EXPECT_EQ(table.conflicts(0, 1, 1), 0);
}

TEST(ConflictAvoidanceTable, CountsManyPathsOnOneCellAfterRemovals) {
  const Grid grid = grid_of({".."});
  ConflictAvoidanceTable table(grid);
  for (int i = 0; i < 300; ++i) table.add({0, 1});
  EXPECT_EQ(table.conflicts(1, 1, 1), 300);
  table.remove({0, 1});
  EXPECT_EQ(table.conflicts(1, 1, 1), 299);
  table.clear();
  EXPECT_EQ(table.conflicts(1, 1, 1), 0);
}

}  // namespace conflict_avoidance_table_test
}  // namespace grove::detail
