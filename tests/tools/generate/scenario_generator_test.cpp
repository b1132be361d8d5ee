// SPDX-License-Identifier: MIT
#include "tools/generate/scenario_generator.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "io/input_error.h"

namespace grove::detail {
namespace scenario_generator_test {

// Two components, with 6 cells on the left and 2 on the right.
Grid two_parts() {
  return Grid(5, 2, {true, true, true, false, true, true, true, true, false, true});
}

TEST(RandomScenario, UsesEachCellOfTheLargestComponentOnce) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const Grid grid = two_parts();
    std::set<Cell> starts;
    std::set<Cell> goals;
    for (const ScenarioRow& row : random_scenario(grid, "maps/m.map", 6, seed, "rows")) {
      EXPECT_EQ(row.map, "m.map");
      EXPECT_FALSE(row.start == row.goal);
      EXPECT_LT(row.start.x, 3);
      EXPECT_LT(row.goal.x, 3);
      starts.insert(grid.cell(row.start));
      goals.insert(grid.cell(row.goal));
    }
    EXPECT_EQ(starts.size(), 6U);
    EXPECT_EQ(goals.size(), 6U);
  }
}

TEST(RandomScenario, RefusesMoreRowsThanCells) {
  EXPECT_THROW(random_scenario(two_parts(), "m.map", 7, 0, "rows"), InputError);
  EXPECT_THROW(random_scenario(Grid(1, 1, {true}), "m.map", 1, 0, "rows"), InputError);
  EXPECT_THROW(random_scenario(Grid(1, 1, {false}), "m.map", 1, 0, "rows"), InputError);
}

TEST(ScenarioLengths, AreGridDistances) {
  const std::vector<ScenarioRow> rows{{2, "m.map", 5, 2, {0, 0}, {2, 1}},
                                      {3, "m.map", 5, 2, {1, 1}, {1, 1}}};
  EXPECT_EQ(scenario_lengths(two_parts(), rows), (std::vector<Time>{3, 0}));
}

}  // namespace scenario_generator_test
}  // namespace grove::detail
