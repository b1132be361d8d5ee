// SPDX-License-Identifier: MIT
#include "primal/prioritized_planning.h"

#include <gtest/gtest.h>

#include <numeric>
#include <string>
#include <vector>

#include "tests/support/instances.h"

namespace grove::detail {
namespace prioritized_planning_test {

// Agent 0 crosses a square diagonally. Of its 70 paths of least cost, four meet none of the other
// agents, each of which has only one path of least cost.
Instance crossed_square() {
  return testing::instance_of(std::vector<std::string>(7, std::string(10, '.')),
                              {{{0, 0}, Position{4, 4}},
                               {{0, 4}, Position{0, 2}},
                               {{4, 4}, Position{4, 0}},
                               {{3, 1}, Position{0, 1}},
                               {{2, 6}, Position{2, 1}},
                               {{9, 3}, Position{0, 3}}});
}

// The agent planned first leaves the individual paths of the others free.
TEST(PrioritizedPlanning, BreaksTiesByTheIndividualPathsOfTheOthers) {
  const Instance instance = crossed_square();
  const Problem problem(instance, Limits());
  AgentStopsCache stops(instance, problem.distances);
  PrimalLowLevel low_level(problem, stops);
  PlannedPaths paths(instance);
  Random random(0);
  const Tuning tuning;
  PrioritizedPlanning planning(instance.world(), low_level, paths, random, tuning);
  Cost individual_costs = 0;
  for (AgentIndex agent = 0; agent < instance.agent_count(); ++agent) {
    ASSERT_TRUE(low_level.plan_individually(agent, Limits()));
    individual_costs += low_level.individual_cost(agent);
  }
  std::vector<AgentIndex> order(static_cast<std::size_t>(instance.agent_count()));
  std::iota(order.begin(), order.end(), 0);
  for (int round = 0; round < 2; ++round) {  // the second order starts afresh
    planning.begin(order);
    PrioritizedPlanning::Outcome outcome;
    do outcome = planning.step(Limits());
    while (outcome == PrioritizedPlanning::Outcome::kWorking);
    ASSERT_EQ(outcome, PrioritizedPlanning::Outcome::kDone);
    EXPECT_EQ(paths.cost(), individual_costs);
  }
}

}  // namespace prioritized_planning_test
}  // namespace grove::detail
