// SPDX-License-Identifier: MIT
#include "planning/safe_intervals.h"

#include <gtest/gtest.h>

#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

namespace grove::detail {
namespace safe_intervals_test {

using Intervals = std::vector<std::pair<Time, Time>>;

class SafeIntervalsTest : public ::testing::Test {
 protected:
  Intervals of(Cell cell) const {
    Intervals result;
    for (int slot = intervals_.first_slot(cell); slot < intervals_.end_slot(cell); ++slot) {
      EXPECT_EQ(intervals_.state_of(slot), cell);
      result.emplace_back(intervals_.begin_of(slot), intervals_.end_of(slot));
    }
    return result;
  }

  static Constraint no_rest(Cell cell, Time by) {
    return {cell, kNoCell, 0, by, ConstraintKind::kNoRestBy};
  }
  static Constraint rest(Cell cell, Time by) {
    return {cell, kNoCell, 0, by, ConstraintKind::kRestBy};
  }

  Grid grid_{3, 1, std::vector<bool>(3, true)};
  SafeIntervals intervals_{grid_};
};

TEST_F(SafeIntervalsTest, UnconstrainedCellsAreAlwaysSafe) {
  intervals_.assign({});
  EXPECT_TRUE(intervals_.unconstrained(1));
  EXPECT_EQ(of(1), (Intervals{{0, kNever}}));
}

TEST_F(SafeIntervalsTest, VertexConstraintsAreMergedInAnyOrder) {
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
  EXPECT_EQ(intervals_.start_slot(1), first);
  EXPECT_EQ(intervals_.rest_begin(1), 10);
}

TEST_F(SafeIntervalsTest, VertexConstraintForeverRemovesLastInterval) {
  intervals_.assign(std::vector<Constraint>{{0, kNoCell, 4, kNever}, {1, kNoCell, 0, kNever}});
  EXPECT_EQ(of(0), (Intervals{{0, 3}}));
  EXPECT_EQ(of(1), Intervals{});
  EXPECT_EQ(intervals_.last_time(0), 3);
  EXPECT_EQ(intervals_.last_time(1), -1);
  EXPECT_EQ(intervals_.last_time(2), kNever);
  EXPECT_EQ(intervals_.rest_begin(0), kNever);
  EXPECT_EQ(intervals_.rest_begin(2), 0);
  EXPECT_EQ(intervals_.start_slot(1), -1);
}

TEST_F(SafeIntervalsTest, EmptyAndPastRangesBarNothing) {
  intervals_.assign(std::vector<Constraint>{{0, kNoCell, 4, 3}, {0, kNoCell, -5, -1}});
  EXPECT_TRUE(intervals_.unconstrained(0));
}

TEST_F(SafeIntervalsTest, EdgeConstraintsDelayOnlyTheirMove) {
  intervals_.assign(
      std::vector<Constraint>{{1, 0, 6, 8}, {1, 0, 3, 6}, {1, 2, 9, 9}, {1, 0, 20, kNever}});
  EXPECT_EQ(of(1), (Intervals{{0, kNever}}));
  EXPECT_EQ(intervals_.first_move(0, 1, 2), 2);
  EXPECT_EQ(intervals_.first_move(0, 1, 3), 9);
  EXPECT_EQ(intervals_.first_move(2, 1, 9), 10);
  EXPECT_GT(intervals_.first_move(0, 1, 20), kNever);
  EXPECT_EQ(intervals_.last_move(0, 1, kNever), 19);
  EXPECT_EQ(intervals_.last_move(0, 1, 8), 2);
  EXPECT_EQ(intervals_.last_move(2, 1, 8), 8);
  EXPECT_EQ(intervals_.last_move(2, 1, 9), 8);
}

// Compares, for each time, the first allowed move at that time or later and the last allowed move
// at that time or earlier.
TEST_F(SafeIntervalsTest, FirstAndLastMovesSkipEdgeConstraints) {
  constexpr Time kEnd = 24;
  std::mt19937 random(1);
  const auto below = [&](int bound) {
    return static_cast<Time>(random() % static_cast<unsigned>(bound));
  };
  for (int round = 0; round < 500; ++round) {
    std::vector<Constraint> bars;
    std::vector<bool> barred(kEnd, false);
    for (int n = below(8); n >= 0; --n) {
      const Time begin = below(kEnd - 4);
      const Cell from = below(4) == 0 ? 2 : 0;
      bars.push_back({1, from, begin, begin + below(5)});
      if (from == 2) continue;
      for (Time t = begin; t <= bars.back().end; ++t) barred[t] = true;
    }
    intervals_.assign(bars);
    for (Time time = 0; time < kEnd; ++time) {
      Time first = time;
      while (first < kEnd && barred[first]) ++first;
      Time last = time;
      while (last >= 0 && barred[last]) --last;
      EXPECT_EQ(intervals_.first_move(0, 1, time), first);
      EXPECT_EQ(intervals_.last_move(0, 1, time), last);
    }
  }
}

TEST_F(SafeIntervalsTest, NoRestBySplitsTheLastIntervalByArrival) {
  intervals_.assign(
      std::vector<Constraint>{{1, kNoCell, 2, 3}, no_rest(1, 7), no_rest(1, 5), no_rest(0, -1)});
  EXPECT_EQ(of(1), (Intervals{{0, 1}, {4, kNever}, {8, kNever}}));
  EXPECT_EQ(intervals_.rest_begin(1), 8);
  EXPECT_EQ(intervals_.next_begin(intervals_.first_slot(1) + 1), 8);
  EXPECT_TRUE(intervals_.unconstrained(0));
  intervals_.assign(std::vector<Constraint>{{1, kNoCell, 2, 3}, no_rest(1, 3), no_rest(2, kNever)});
  EXPECT_EQ(of(1), (Intervals{{0, 1}, {4, kNever}}));
  EXPECT_EQ(intervals_.rest_begin(1), 4);
  EXPECT_EQ(of(2), (Intervals{{0, kNever}}));
  EXPECT_EQ(intervals_.rest_begin(2), kNever);
}

TEST_F(SafeIntervalsTest, RestByLeavesOnePlaceToRest) {
  intervals_.assign(std::vector<Constraint>{rest(1, 7), rest(1, 5)});
  EXPECT_EQ(intervals_.latest_rest(), 5);
  EXPECT_EQ(intervals_.only_rest(), 1);
  EXPECT_EQ(intervals_.rest_begin(1), 0);
  EXPECT_EQ(intervals_.rest_begin(0), kNever);
  intervals_.assign(std::vector<Constraint>{rest(1, 7), rest(2, 5), rest(1, 7)});
  EXPECT_EQ(intervals_.rest_begin(1), kNever);
  EXPECT_EQ(intervals_.rest_begin(2), kNever);
  intervals_.assign({});
  EXPECT_EQ(intervals_.latest_rest(), kNever);
  EXPECT_EQ(intervals_.rest_begin(0), 0);
}

// A corridor 0 - 1 - 2 with inner cell 1.
TEST_F(SafeIntervalsTest, TraversalIsBarredOnlyFromTheOtherEnd) {
  intervals_.assign(
      std::vector<Constraint>{{1, kNoCell, 3, 3}, {2, 1, 5, 6, ConstraintKind::kNoTraversal}});
  EXPECT_EQ(of(1), (Intervals{{0, 2}, {4, kNever}, {0, 2}, {4, kNever}}));
  const auto enter = [&](Cell from) {
    int entered = -1;
    intervals_.for_each_move(from, 3, [&](int slot, State, Time) { entered = slot; });
    return entered;
  };
  EXPECT_EQ(intervals_.first_move(enter(0), 2, 5), 7);
  EXPECT_EQ(intervals_.first_move(enter(2), 2, 5), 5);
  EXPECT_EQ(intervals_.first_move(enter(0), 0, 5), 5);
  EXPECT_EQ(intervals_.first_move(intervals_.start_slot(1), 2, 5), 5);
  EXPECT_EQ(intervals_.last_move(enter(0), 2, 6), 4);
  EXPECT_EQ(intervals_.last_move(enter(2), 2, 6), 6);
  EXPECT_FALSE(intervals_.may_dominate(enter(0)));
  EXPECT_TRUE(intervals_.may_dominate(enter(2)));
  EXPECT_EQ(intervals_.next_begin(enter(0)), kNever);
  EXPECT_EQ(intervals_.next_begin(intervals_.start_slot(1)), 4);
}

TEST_F(SafeIntervalsTest, RejectsTraversalOutsideCorridors) {
  for (const auto& [cell, from] : {std::pair{0, 2}, {1, 0}, {0, kNoCell}})
    EXPECT_THROW(intervals_.assign(
                     std::vector<Constraint>{{cell, from, 0, 1, ConstraintKind::kNoTraversal}}),
                 std::invalid_argument);
}

TEST_F(SafeIntervalsTest, AssignReplacesEarlierConstraints) {
  intervals_.assign(std::vector<Constraint>{{1, kNoCell, 2, 3}, {0, 1, 2, 3}});
  intervals_.assign(std::vector<Constraint>{{2, kNoCell, 2, 3}});
  EXPECT_TRUE(intervals_.unconstrained(0));
  EXPECT_TRUE(intervals_.unconstrained(1));
  EXPECT_EQ(of(2), (Intervals{{0, 1}, {4, kNever}}));
}

TEST_F(SafeIntervalsTest, RejectsConstraintsOutsideTheGrid) {
  for (const Constraint& c :
       {Constraint{3, kNoCell, 0, 0}, Constraint{kNoCell, kNoCell, 0, 0}, Constraint{0, 3, 0, 0},
        Constraint{0, -2, 0, 0}, Constraint{1, 1, 0, 0}})
    EXPECT_THROW(intervals_.assign(std::vector<Constraint>{c}), std::invalid_argument);
  intervals_.assign(std::vector<Constraint>{{1, kNoCell, 2, 3}});
  EXPECT_EQ(of(1), (Intervals{{0, 1}, {4, kNever}}));
}

}  // namespace safe_intervals_test
}  // namespace grove::detail
