// SPDX-License-Identifier: MIT
#include "primal/neighborhoods.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "primal/prioritized_planning.h"
#include "tests/support/instances.h"

namespace grove::detail {
namespace neighborhoods_test {

// Returns an instance with `count` agents that cross an open square from left to right, each from
// its own row and via one task.
Instance crossing(int count) {
  std::vector<testing::AgentSpec> agents;
  for (int i = 0; i < count; ++i)
    agents.push_back({{0, i}, Position{11, (i * 5 + 3) % count}, {{5, (i * 7 + 1) % count}}});
  return testing::instance_of(std::vector<std::string>(12, std::string(12, '.')), agents);
}

// An instance made by crossing(), with a collision-free path for each agent.
struct Planned {
  explicit Planned(int count) : instance(crossing(count)) {
    PrioritizedPlanning planning(instance.world(), low_level, paths, random, tuning);
    std::vector<AgentIndex> order;
    for (AgentIndex agent = 0; agent < instance.agent_count(); ++agent) {
      EXPECT_TRUE(low_level.plan_individually(agent, Limits()));
      order.push_back(agent);
    }
    planning.begin(order);
    while (planning.step(Limits()) == PrioritizedPlanning::Outcome::kWorking) {
    }
  }
  Neighborhoods neighborhoods() { return {problem, low_level, paths, random, tuning}; }

  const Instance instance;
  const Problem problem{instance, Limits()};
  AgentStopsCache stops{instance, problem.distances};
  PrimalLowLevel low_level{problem, stops};
  PlannedPaths paths{instance};
  Random random{1};
  const Tuning tuning;
};

class NeighborhoodsTest : public ::testing::TestWithParam<int> {};

TEST_P(NeighborhoodsTest, HoldDistinctAgentsAndGrowWithoutSuccess) {
  Planned planned(GetParam());
  Neighborhoods neighborhoods = planned.neighborhoods();
  const auto agents = static_cast<std::size_t>(GetParam());
  std::set<std::size_t> sizes;
  std::set<AgentIndex> seen;
  for (int round = 0; round < 500; ++round) {
    const std::vector<AgentIndex> chosen = neighborhoods.choose();
    const std::set<AgentIndex> distinct(chosen.begin(), chosen.end());
    EXPECT_EQ(distinct.size(), chosen.size());
    EXPECT_GE(chosen.size(), std::min<std::size_t>(2, agents));
    EXPECT_LE(chosen.size(), 8u);
    sizes.insert(chosen.size());
    seen.insert(chosen.begin(), chosen.end());
    neighborhoods.reward(round % 3);
  }
  EXPECT_EQ(seen.size(), agents);
  EXPECT_EQ(*sizes.rbegin(), std::min<std::size_t>(8, agents));
  EXPECT_EQ(sizes.contains(6), agents >= 6);

  for (int round = 0; round < 500; ++round) {
    neighborhoods.choose();
    neighborhoods.reward(0);
  }
  std::size_t largest = 0;
  for (int round = 0; round < 50; ++round) {
    largest = std::max(largest, neighborhoods.choose().size());
    neighborhoods.reward(0);
  }
  EXPECT_EQ(largest, agents);
}

// All multipliers are zero, but the path of one agent has a positive reduced cost.
TEST(Neighborhoods, PreferAgentsOfHighReducedCost) {
  Planned planned(12);
  Neighborhoods neighborhoods = planned.neighborhoods();
  const Instance& instance = planned.instance;
  constexpr AgentIndex kHighReducedCost = 5;
  const auto times_chosen = [&] {
    int times = 0;
    for (int round = 0; round < 1000; ++round) {
      times += static_cast<int>(std::ranges::count(neighborhoods.choose(), kHighReducedCost));
      neighborhoods.reward(1);
    }
    return times;
  };
  const int before = times_chosen();
  DualSolution dual{Multipliers(instance.world(), instance.agent_count()), {}, {}};
  for (AgentIndex agent = 0; agent < instance.agent_count(); ++agent) {
    dual.values.push_back(dual.multipliers.price(agent, planned.paths.path(agent)));
    dual.paths.push_back(planned.low_level.individual_path(agent));
  }
  dual.values[kHighReducedCost] -= 10 * Penalties::kUnit;
  planned.low_level.use(std::make_shared<const DualSolution>(std::move(dual)));
  EXPECT_GT(times_chosen(), before + 80);
}

INSTANTIATE_TEST_SUITE_P(Agents, NeighborhoodsTest, ::testing::Values(2, 3, 12));

}  // namespace neighborhoods_test
}  // namespace grove::detail
