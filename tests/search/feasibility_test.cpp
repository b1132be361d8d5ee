// SPDX-License-Identifier: MIT
#include "search/feasibility.h"

#include <gtest/gtest.h>

#include "tests/support/instances.h"

namespace grove::detail {
namespace feasibility_test {

using testing::AgentSpec;

bool infeasible(const std::vector<std::string>& rows, const std::vector<AgentSpec>& agents) {
  const Instance instance = testing::instance_of(rows, agents);
  return presolve_infeasibility(Problem(instance, Limits())).has_value();
}

TEST(PresolveInfeasibility, DetectsUnreachableCells) {
  EXPECT_TRUE(infeasible({".@."}, {{{0, 0}, Position{2, 0}}}));
  EXPECT_TRUE(infeasible({"..@."}, {{{0, 0}, Position{1, 0}, {{3, 0}}}}));
  EXPECT_FALSE(infeasible({"...."}, {{{0, 0}, Position{1, 0}, {{3, 0}}}}));
}

// A <=> B > C, and B > D ("<=>": two-way road, ">": one-way road).
TEST(PresolveInfeasibility, DetectsDeadEndsOfOneWayRoads) {
  const Roadmap roadmap({{"A", {}}, {"B", {}}, {"C", {}}, {"D", {}}},
                        {{0, 1, 2, false}, {1, 2, 1, true}, {1, 3, 1, true}});
  const auto infeasible_for = [&](std::optional<Place> goal, const std::vector<Place>& tasks) {
    InstanceBuilder builder(roadmap);
    builder.add_agent("a", State{0}, goal);
    for (const Place task : tasks)
      builder.add_task("t" + roadmap.name(task), task, std::vector<std::string>{"a"});
    const Instance instance = std::move(builder).build();
    return presolve_infeasibility(Problem(instance, Limits())).has_value();
  };
  EXPECT_FALSE(infeasible_for(2, {0, 1}));
  EXPECT_FALSE(infeasible_for(std::nullopt, {2, 1, 0}));
  EXPECT_TRUE(infeasible_for(std::nullopt, {2, 3}));
  EXPECT_TRUE(infeasible_for(0, {2}));
  EXPECT_TRUE(infeasible_for(3, {1, 2}));
}

TEST(PresolveInfeasibility, DetectsTooFewCellsToRestOn) {
  const std::vector<std::string> open{"...", "...", "..."};
  EXPECT_TRUE(infeasible(open, {{{0, 0}, {}, {{1, 1}}}, {{2, 2}, {}, {{1, 1}}}}));
  EXPECT_TRUE(infeasible(open, {{{0, 0}, {}, {{1, 1}}}, {{2, 2}, Position{1, 1}}}));
  EXPECT_FALSE(infeasible(open, {{{0, 0}, {}, {{1, 1}, {0, 1}}}, {{2, 2}, {}, {{1, 1}}}}));
  // The first agent must take a different cell, which requires an augmenting path.
  EXPECT_FALSE(infeasible(
      open,
      {{{0, 0}, {}, {{1, 1}, {2, 1}}}, {{0, 1}, {}, {{1, 1}, {2, 0}}}, {{2, 2}, {}, {{1, 1}}}}));
  EXPECT_TRUE(infeasible(open, {{{0, 0}, {}, {{1, 1}, {2, 1}}},
                                {{0, 1}, {}, {{1, 1}, {2, 1}}},
                                {{2, 2}, {}, {{1, 1}, {2, 1}}}}));
}

TEST(PresolveInfeasibility, DetectsAgentsThatMustSwapInACorridor) {
  EXPECT_TRUE(infeasible({"....."}, {{{0, 0}, Position{4, 0}}, {{3, 0}, Position{1, 0}}}));
  EXPECT_FALSE(infeasible({"....."}, {{{0, 0}, Position{3, 0}}, {{1, 0}, Position{4, 0}}}));
  // In the bay one agent can let the other pass.
  EXPECT_FALSE(
      infeasible({".....", "@@.@@"}, {{{0, 0}, Position{4, 0}}, {{3, 0}, Position{1, 0}}}));
}

TEST(PresolveInfeasibility, DetectsTasksBehindRestingAgents) {
  EXPECT_TRUE(
      infeasible({"....."}, {{{1, 0}, Position{1, 0}}, {{3, 0}, Position{3, 0}, {{0, 0}}}}));
  EXPECT_FALSE(
      infeasible({"....."}, {{{1, 0}, Position{1, 0}}, {{3, 0}, Position{3, 0}, {{1, 0}}}}));
}

TEST(PresolveInfeasibility, FollowsBentCorridorsAndIgnoresRings) {
  EXPECT_TRUE(
      infeasible({"..@", "@..", "@@."}, {{{0, 0}, Position{2, 2}}, {{2, 2}, Position{0, 0}}}));
  EXPECT_FALSE(
      infeasible({"...", ".@.", "..."}, {{{0, 0}, Position{2, 2}}, {{2, 2}, Position{0, 0}}}));
}

}  // namespace feasibility_test
}  // namespace grove::detail
