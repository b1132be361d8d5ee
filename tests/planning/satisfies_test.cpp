// SPDX-License-Identifier: MIT
#include "tests/support/satisfies.h"

#include <gtest/gtest.h>

#include "tests/planning/single_agent.h"

namespace grove::detail::testing {
namespace satisfies_test {

TEST(Satisfies, CountsRestForever) {
  const Grid grid = grid_of({"..."});
  const Path path{0, 1, 2};
  EXPECT_TRUE(satisfies(grid, path, {1, kNoCell, 2, kNever}));
  EXPECT_FALSE(satisfies(grid, path, {1, kNoCell, 1, 1}));
  EXPECT_FALSE(satisfies(grid, path, {2, kNoCell, 90, 90}));
  EXPECT_FALSE(satisfies(grid, path, {2, kNoCell, 0, kNever}));
  EXPECT_FALSE(satisfies(grid, path, {2, 1, 2, 2}));
  EXPECT_TRUE(satisfies(grid, path, {2, 1, 3, kNever}));
  EXPECT_TRUE(satisfies(grid, path, {1, 2, 0, kNever}));
}

TEST(Satisfies, UsesTimeOfLastArrival) {
  const Grid grid = grid_of({"..."});
  const auto no_rest = [](Cell cell, Time by) {
    return Constraint{cell, kNoCell, 0, by, ConstraintKind::kNoRestBy};
  };
  const auto rest = [](Cell cell, Time by) {
    return Constraint{cell, kNoCell, 0, by, ConstraintKind::kRestBy};
  };
  const Path path{1, 2, 1, 2, 2};  // the last step is a wait
  EXPECT_FALSE(satisfies(grid, path, no_rest(2, 3)));
  EXPECT_TRUE(satisfies(grid, path, no_rest(2, 2)));
  EXPECT_TRUE(satisfies(grid, path, no_rest(1, kNever)));
  EXPECT_TRUE(satisfies(grid, path, rest(2, 3)));
  EXPECT_FALSE(satisfies(grid, path, rest(2, 2)));
  EXPECT_FALSE(satisfies(grid, path, rest(1, kNever)));
  EXPECT_FALSE(satisfies(grid, {1}, no_rest(1, 0)));
  EXPECT_TRUE(satisfies(grid, {1}, no_rest(1, -1)));
  EXPECT_TRUE(satisfies(grid, {1}, rest(1, 0)));
}

// A corridor 0 - 1 - 2 - 3 with inner cells 1 and 2.
TEST(Satisfies, DistinguishesTraversalFromTurningBack) {
  const Grid grid = grid_of({"...."});
  const auto leaves = [](Cell end, Cell inner, Time begin, Time until) {
    return Constraint{end, inner, begin, until, ConstraintKind::kNoTraversal};
  };
  const Path through{0, 1, 1, 2, 3};
  EXPECT_FALSE(satisfies(grid, through, leaves(3, 2, 4, 4)));
  EXPECT_TRUE(satisfies(grid, through, leaves(3, 2, 0, 3)));
  EXPECT_TRUE(satisfies(grid, through, leaves(3, 2, 5, kNever)));
  EXPECT_TRUE(satisfies(grid, through, leaves(0, 1, 0, kNever)));
  EXPECT_TRUE(satisfies(grid, {3, 2, 1, 2, 3}, leaves(3, 2, 0, kNever)));
  EXPECT_TRUE(satisfies(grid, {1, 2, 3}, leaves(3, 2, 0, kNever)));
  EXPECT_FALSE(satisfies(grid, {1, 0, 1, 2, 3}, leaves(3, 2, 0, kNever)));
}

// In a loop the agent leaves through the cell by which it entered.
TEST(Satisfies, RecognizesTraversalOfLoop) {
  const Grid grid = grid_of({"..@", "...", "@.@"});
  const Constraint left{4, 3, 0, kNever, ConstraintKind::kNoTraversal};
  EXPECT_FALSE(satisfies(grid, {7, 4, 1, 0, 3, 4}, left));
  EXPECT_TRUE(satisfies(grid, {7, 4, 3, 0, 3, 4}, left));
  EXPECT_TRUE(satisfies(grid, {7, 4, 3, 0, 1, 4}, left));
}

}  // namespace satisfies_test
}  // namespace grove::detail::testing
