// SPDX-License-Identifier: MIT
// Examples for the test of infeasibility. grove-fuzz-feasibility compares the test with an
// exhaustive search on tiny dense instances.
#include "search/pebble_motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/instances.h"

namespace grove::detail {
namespace pebble_motion_test {

using testing::AgentSpec;
using Rows = std::vector<std::string>;

std::string reason(const Instance& instance) {
  return pebble_motion_infeasibility(instance).value_or("");
}
bool is_infeasible(const Instance& instance) {
  return pebble_motion_infeasibility(instance).has_value();
}

// Returns an instance with agents on all cells except `free`, row by row. Each agent has its start
// as its goal, but the first two agents must swap.
Instance swapped(const Rows& rows, const std::vector<Position>& free) {
  std::vector<Position> cells;
  for (int y = 0; y < static_cast<int>(rows.size()); ++y)
    for (int x = 0; x < static_cast<int>(rows[y].size()); ++x)
      if (rows[y][x] == '.' && std::ranges::count(free, Position{x, y}) == 0)
        cells.push_back({x, y});
  std::vector<AgentSpec> agents;
  for (const Position cell : cells) agents.push_back({cell, cell});
  std::swap(agents[0].goal, agents[1].goal);
  return testing::instance_of(rows, agents);
}

TEST(PebbleMotion, DetectsOddPermutationsOfTheFifteenPuzzle) {
  const Rows board(4, "....");
  EXPECT_TRUE(is_infeasible(swapped(board, {{3, 3}}).without_following()));
  EXPECT_FALSE(is_infeasible(swapped(board, {{3, 3}, {2, 3}}).without_following()));
  EXPECT_FALSE(is_infeasible(swapped(board, {{3, 3}})));
  EXPECT_FALSE(is_infeasible(swapped(board, {})));
  EXPECT_TRUE(is_infeasible(swapped(board, {}).without_following()));
}

TEST(PebbleMotion, DetectsSwapsOnARing) {
  const Rows ring{"...", ".@.", "..."};
  EXPECT_TRUE(is_infeasible(swapped(ring, {})));
  EXPECT_TRUE(is_infeasible(swapped(ring, {{2, 2}, {1, 2}})));
  EXPECT_FALSE(is_infeasible(swapped({"....", ".@.@", "...@"}, {{3, 0}})));
}

TEST(PebbleMotion, DetectsSwapsTooFarFromACrossing) {
  const Rows dead_end{".....", "@@@.@"};
  EXPECT_TRUE(is_infeasible(swapped(dead_end, {{3, 1}, {4, 0}, {3, 0}})));
  EXPECT_FALSE(is_infeasible(swapped({"....", "@@.@"}, {{2, 1}, {3, 0}, {2, 0}})));
}

TEST(PebbleMotion, NamesTheAgentAndItsUnreachablePlace) {
  const Rows dead_end{"......", "@@@@..", "@@@@.."};
  std::vector<AgentSpec> agents;
  for (int x = 0; x < 6; ++x) agents.push_back({{x, 0}, Position{x, 0}});
  for (int x = 4; x < 6; ++x) agents.push_back({{x, 1}, Position{x, 1}});
  agents[0].tasks = {{4, 2}};
  EXPECT_EQ(reason(testing::instance_of(dead_end, agents)),
            "agent 'a0' cannot reach [4, 2]: the agents have too little room to let it pass");
  agents[0].tasks = {};
  agents[3].tasks = {{4, 2}};
  EXPECT_EQ(reason(testing::instance_of(dead_end, agents)), "");
}

// A task that none of its agents can reach is detected even if agents have no goals.
TEST(PebbleMotion, ChecksTasksOfAgentsWithoutGoals) {
  std::vector<AgentSpec> agents{
      {{0, 0}, {}, {{3, 1}}}, {{1, 0}, {}}, {{2, 0}, {}}, {{3, 0}, {}}, {{4, 0}, {}}};
  EXPECT_TRUE(is_infeasible(testing::instance_of({".....", "@@@.@"}, agents)));
  agents.resize(2);
  EXPECT_FALSE(is_infeasible(testing::instance_of({".....", "@@@.@"}, agents)));
}

}  // namespace pebble_motion_test
}  // namespace grove::detail
