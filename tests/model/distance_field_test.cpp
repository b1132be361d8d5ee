// SPDX-License-Identifier: MIT
#include "grove/detail/model/distance_field.h"

#include <gtest/gtest.h>

namespace grove::detail {
namespace distance_field_test {

TEST(DistanceField, WalksAroundWalls) {
  // . @ .
  // . @ .
  // . . .
  const Grid grid(3, 3, {true, false, true, true, false, true, true, true, true});
  const DistanceField field = distance_field(grid, grid.cell({2, 0}));
  EXPECT_EQ(field[grid.cell({0, 0})], 6);
  EXPECT_EQ(field[grid.cell({2, 0})], 0);
  EXPECT_EQ(field[grid.cell({1, 0})], kNever);
}

TEST(DistanceField, UnreachableIsNever) {
  const Grid grid(3, 1, {true, false, true});
  EXPECT_EQ(distance_field(grid, 0)[2], kNever);
}

TEST(DistanceFields, HoldsTasksAndDestinations) {
  InstanceBuilder builder(Grid(4, 1, std::vector<bool>(4, true)));
  builder.add_agent("a", {0, 0}, Position{3, 0});
  builder.add_task("t", {1, 0}, std::vector<std::string>{"a"});
  const Instance instance = std::move(builder).build();
  const DistanceFields fields(instance);
  EXPECT_EQ(fields.to_rest(0)[0], 3);
  EXPECT_EQ(fields.to_task(0)[3], 2);
}

}  // namespace distance_field_test
}  // namespace grove::detail
