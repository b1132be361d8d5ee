// SPDX-License-Identifier: MIT
#include "sequencing/cost_matrix.h"

#include <gtest/gtest.h>

#include <string>

namespace grove::detail {
namespace cost_matrix_test {

// A row of cells of which one is blocked:  0 1 2 3 # 5
Instance corridor(std::optional<Position> goal, const std::vector<Position>& tasks) {
  std::vector<bool> passable(6, true);
  passable[4] = false;
  InstanceBuilder builder(Grid(6, 1, passable));
  const std::string agent = "a";
  builder.add_agent(agent, {1, 0}, goal);
  for (std::size_t i = 0; i < tasks.size(); ++i)
    builder.add_task("t" + std::to_string(i), tasks[i], {&agent, 1});
  return std::move(builder).build();
}

CostMatrix matrix_of(const Instance& instance) {
  return cost_matrix(instance, 0, DistanceFields(instance));
}

TEST(CostMatrix, HoldsDistancesBetweenStartStopsAndDestination) {
  const CostMatrix matrix = matrix_of(corridor(Position{3, 0}, {{0, 0}, {2, 0}}));
  EXPECT_EQ(matrix.stops(), 2);
  EXPECT_EQ(matrix.all(), StopSet{3});
  EXPECT_EQ(matrix.from_start(0), 1);
  EXPECT_EQ(matrix.from_start(1), 1);
  EXPECT_EQ(matrix.between(0, 1), 2);
  EXPECT_EQ(matrix.between(1, 0), 2);
  EXPECT_EQ(matrix.to_end(0), 3);
  EXPECT_EQ(matrix.to_end(1), 1);
  EXPECT_EQ(sequence_cost(matrix, {0, 1}), 4);
  EXPECT_EQ(sequence_cost(matrix, {1, 0}), 6);
}

TEST(CostMatrix, EndsAnywhereWithoutDestination) {
  const CostMatrix matrix = matrix_of(corridor(std::nullopt, {{0, 0}, {2, 0}}));
  EXPECT_EQ(matrix.to_end(0), 0);
  EXPECT_EQ(matrix.to_end(1), 0);
  EXPECT_EQ(sequence_cost(matrix, {1, 0}), 3);
}

TEST(CostMatrix, WithoutTasksHoldsDistanceToTheDestination) {
  const CostMatrix matrix = matrix_of(corridor(Position{3, 0}, {}));
  EXPECT_EQ(matrix.stops(), 0);
  EXPECT_EQ(sequence_cost(matrix, {}), 2);
}

TEST(CostMatrix, HoldsNeverForUnreachablePlaces) {
  const CostMatrix matrix = matrix_of(corridor(Position{3, 0}, {{0, 0}, {5, 0}}));
  EXPECT_EQ(matrix.from_start(1), kNever);
  EXPECT_EQ(matrix.between(0, 1), kNever);
  EXPECT_EQ(sequence_cost(matrix, {0, 1}), kNever);
  EXPECT_EQ(sequence_cost(matrix, {1, 0}), kNever);
}

TEST(CostMatrix, HoldsSixtyFourStops) {
  const CostMatrix matrix{CostMatrix::Matrix(65)};
  EXPECT_EQ(matrix.all(), ~StopSet{0});
}

}  // namespace cost_matrix_test
}  // namespace grove::detail
