// SPDX-License-Identifier: MIT
#include "search/feasibility.h"

#include <gtest/gtest.h>

#include "tests/support/instances.h"

namespace grove::detail {
namespace feasibility_test {

using testing::AgentSpec;

bool evident(const std::vector<std::string>& rows, const std::vector<AgentSpec>& agents) {
  const Instance instance = testing::instance_of(rows, agents);
  return presolve_infeasibility(Problem(instance, Limits())).has_value();
}

TEST(EvidentInfeasibility, SeesCellsWithoutAWay) {
  EXPECT_TRUE(evident({".@."}, {{{0, 0}, Position{2, 0}}}));
  EXPECT_TRUE(evident({"..@."}, {{{0, 0}, Position{1, 0}, {{3, 0}}}}));
  EXPECT_FALSE(evident({"...."}, {{{0, 0}, Position{1, 0}, {{3, 0}}}}));
}

// A <=> B > C, and B > D.
TEST(EvidentInfeasibility, SeesThatNoWayLeadsOn) {
  const Roadmap roadmap({{"A", {}}, {"B", {}}, {"C", {}}, {"D", {}}},
                        {{0, 1, 2, false}, {1, 2, 1, true}, {1, 3, 1, true}});
  const auto evident_for = [&](std::optional<Place> goal, const std::vector<Place>& tasks) {
    InstanceBuilder builder(roadmap);
    builder.add_agent("a", State{0}, goal);
    for (const Place task : tasks)
      builder.add_task("t" + roadmap.name(task), task, std::vector<std::string>{"a"});
    const Instance instance = std::move(builder).build();
    return presolve_infeasibility(Problem(instance, Limits())).has_value();
  };
  EXPECT_FALSE(evident_for(2, {0, 1}));
  EXPECT_FALSE(evident_for(std::nullopt, {2, 1, 0}));
  EXPECT_TRUE(evident_for(std::nullopt, {2, 3}));
  EXPECT_TRUE(evident_for(0, {2}));
  EXPECT_TRUE(evident_for(3, {1, 2}));
}

TEST(EvidentInfeasibility, SeesTooFewCellsToRestOn) {
  const std::vector<std::string> open{"...", "...", "..."};
  EXPECT_TRUE(evident(open, {{{0, 0}, {}, {{1, 1}}}, {{2, 2}, {}, {{1, 1}}}}));
  EXPECT_TRUE(evident(open, {{{0, 0}, {}, {{1, 1}}}, {{2, 2}, Position{1, 1}}}));
  EXPECT_FALSE(evident(open, {{{0, 0}, {}, {{1, 1}, {0, 1}}}, {{2, 2}, {}, {{1, 1}}}}));
  // The first agent must give way: an augmenting path.
  EXPECT_FALSE(evident(
      open,
      {{{0, 0}, {}, {{1, 1}, {2, 1}}}, {{0, 1}, {}, {{1, 1}, {2, 0}}}, {{2, 2}, {}, {{1, 1}}}}));
  EXPECT_TRUE(evident(open, {{{0, 0}, {}, {{1, 1}, {2, 1}}},
                             {{0, 1}, {}, {{1, 1}, {2, 1}}},
                             {{2, 2}, {}, {{1, 1}, {2, 1}}}}));
}

TEST(EvidentInfeasibility, SeesThatNobodyPassesInACorridor) {
  EXPECT_TRUE(evident({"....."}, {{{0, 0}, Position{4, 0}}, {{3, 0}, Position{1, 0}}}));
  EXPECT_FALSE(evident({"....."}, {{{0, 0}, Position{3, 0}}, {{1, 0}, Position{4, 0}}}));
  // A bay to pass in.
  EXPECT_FALSE(evident({".....", "@@.@@"}, {{{0, 0}, Position{4, 0}}, {{3, 0}, Position{1, 0}}}));
}

TEST(EvidentInfeasibility, SeesTasksBehindOtherAgents) {
  EXPECT_TRUE(evident({"....."}, {{{1, 0}, Position{1, 0}}, {{3, 0}, Position{3, 0}, {{0, 0}}}}));
  EXPECT_FALSE(evident({"....."}, {{{1, 0}, Position{1, 0}}, {{3, 0}, Position{3, 0}, {{1, 0}}}}));
}

TEST(EvidentInfeasibility, WalksBentCorridorsAndLeavesRingsAlone) {
  EXPECT_TRUE(evident({"..@", "@..", "@@."}, {{{0, 0}, Position{2, 2}}, {{2, 2}, Position{0, 0}}}));
  EXPECT_FALSE(
      evident({"...", ".@.", "..."}, {{{0, 0}, Position{2, 2}}, {{2, 2}, Position{0, 0}}}));
}

}  // namespace feasibility_test
}  // namespace grove::detail
