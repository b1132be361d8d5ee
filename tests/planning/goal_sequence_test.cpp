// SPDX-License-Identifier: MIT
#include "planning/goal_sequence.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/planning/single_agent.h"

namespace grove::detail {
namespace goal_sequence_test {

using testing::grid_of;
using testing::SingleAgent;

TEST(GoalSequence, EndsAtTheDestination) {
  const Grid grid = grid_of({"......"});
  const SingleAgent agent(grid, 2, {0, 5}, 3);
  EXPECT_EQ(agent.goals.start(), 2);
  ASSERT_EQ(agent.goals.size(), 3);
  EXPECT_EQ(agent.goals.goal(0), 0);
  EXPECT_EQ(agent.goals.last(), 3);
}

TEST(GoalSequence, EndsAtLastTaskWithoutDestination) {
  const Grid grid = grid_of({"......"});
  const SingleAgent agent(grid, 2, {0, 5}, std::nullopt);
  EXPECT_EQ(agent.goals.size(), 2);
  EXPECT_EQ(agent.goals.last(), 5);
}

TEST(GoalSequence, DistanceIncludesTheRemainingGoals) {
  const Grid grid = grid_of({"......"});
  const SingleAgent agent(grid, 2, {0, 5}, 3);
  EXPECT_EQ(agent.goals.distance(2, 0), 2 + 5 + 2);
  EXPECT_EQ(agent.goals.distance(2, 1), 3 + 2);
  EXPECT_EQ(agent.goals.distance(2, 2), 1);
}

TEST(GoalSequence, DistanceAcrossWallIsNever) {
  const Grid grid = grid_of({"..@.@.."});
  const SingleAgent agent(grid, 0, {3, 5, 1}, 6);
  for (int k = 0; k < agent.goals.size(); ++k) EXPECT_GE(agent.goals.distance(0, k), kNever);
}

TEST(GoalSequence, AgentWithoutGoalsRestsAnywhere) {
  const Grid grid = grid_of({".."});
  const SingleAgent agent(grid, 0, {}, std::nullopt);
  EXPECT_EQ(agent.goals.size(), 1);
  EXPECT_EQ(agent.goals.last(), kNoPlace);
  EXPECT_EQ(agent.goals.distance(1, 0), 0);
}

}  // namespace goal_sequence_test
}  // namespace grove::detail
