// SPDX-License-Identifier: MIT
#include "src/planning/safe_intervals.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <utility>
#include <vector>

namespace grove {
namespace {

using Intervals = std::vector<std::pair<Time, Time>>;

class SafeIntervalsTest : public ::testing::Test {
 protected:
  Intervals of(Cell cell) const {
    Intervals result;
    for (int slot = intervals_.first_slot(cell); slot < intervals_.end_slot(cell); ++slot) {
      EXPECT_EQ(intervals_.cell_of(slot), cell);
      result.emplace_back(intervals_.begin_of(slot), intervals_.end_of(slot));
    }
    return result;
  }

  Grid grid_{3, 1, std::vector<bool>(3, true)};
  SafeIntervals intervals_{grid_};
};

TEST_F(SafeIntervalsTest, UnconstrainedCellsAreAlwaysSafe) {
  intervals_.assign({});
  EXPECT_TRUE(intervals_.unconstrained(1));
  EXPECT_EQ(of(1), (Intervals{{0, kNever}}));
}

TEST_F(SafeIntervalsTest, BarsAreMergedInAnyOrder) {
  intervals_.assign(std::vector<Constraint>{{1, kNoCell, 7, 9},
                                            {1, kNoCell, 2, 3},
                                            {1, kNoCell, 3, 4},
                                            {1, kNoCell, 2, 3},
                                            {1, kNoCell, 5, 5}});
  EXPECT_EQ(of(1), (Intervals{{0, 1}, {6, 6}, {10, kNever}}));
  EXPECT_EQ(of(0), (Intervals{{0, kNever}}));
  const int first = intervals_.first_slot(1);
  EXPECT_EQ(intervals_.next_begin(first), 6);
  EXPECT_EQ(intervals_.next_begin(first + 2), kNever);
  EXPECT_EQ(intervals_.slot_at(1, 6), first + 1);
  EXPECT_EQ(intervals_.slot_at(1, 3), -1);
}

TEST_F(SafeIntervalsTest, BarsForEverLeaveNoLastInterval) {
  intervals_.assign(std::vector<Constraint>{{0, kNoCell, 4, kNever}, {1, kNoCell, 0, kNever}});
  EXPECT_EQ(of(0), (Intervals{{0, 3}}));
  EXPECT_EQ(of(1), Intervals{});
  EXPECT_EQ(intervals_.last_slot(0), -1);
  EXPECT_EQ(intervals_.last_slot(2), 2);
}

TEST_F(SafeIntervalsTest, EmptyAndPastRangesBarNothing) {
  intervals_.assign(std::vector<Constraint>{{0, kNoCell, 4, 3}, {0, kNoCell, -5, -1}});
  EXPECT_TRUE(intervals_.unconstrained(0));
}

TEST_F(SafeIntervalsTest, BarredMovesDelayOnlyThatMove) {
  intervals_.assign(
      std::vector<Constraint>{{1, 0, 6, 8}, {1, 0, 3, 6}, {1, 2, 9, 9}, {1, 0, 20, kNever}});
  EXPECT_EQ(of(1), (Intervals{{0, kNever}}));
  EXPECT_EQ(intervals_.first_move(0, 1, 2), 2);
  EXPECT_EQ(intervals_.first_move(0, 1, 3), 9);
  EXPECT_EQ(intervals_.first_move(2, 1, 9), 10);
  EXPECT_GT(intervals_.first_move(0, 1, 20), kNever);
}

TEST_F(SafeIntervalsTest, AssigningAgainForgetsTheOldConstraints) {
  intervals_.assign(std::vector<Constraint>{{1, kNoCell, 2, 3}, {0, 1, 2, 3}});
  intervals_.assign(std::vector<Constraint>{{2, kNoCell, 2, 3}});
  EXPECT_TRUE(intervals_.unconstrained(0));
  EXPECT_TRUE(intervals_.unconstrained(1));
  EXPECT_EQ(of(2), (Intervals{{0, 1}, {4, kNever}}));
}

TEST_F(SafeIntervalsTest, RejectsWhatIsNotOnTheGrid) {
  for (const Constraint& c :
       {Constraint{3, kNoCell, 0, 0}, Constraint{kNoCell, kNoCell, 0, 0}, Constraint{0, 3, 0, 0},
        Constraint{0, -2, 0, 0}, Constraint{1, 1, 0, 0}})
    EXPECT_THROW(intervals_.assign(std::vector<Constraint>{c}), std::invalid_argument);
  intervals_.assign(std::vector<Constraint>{{1, kNoCell, 2, 3}});
  EXPECT_EQ(of(1), (Intervals{{0, 1}, {4, kNever}}));
}

}  // namespace
}  // namespace grove
