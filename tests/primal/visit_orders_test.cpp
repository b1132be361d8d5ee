// SPDX-License-Identifier: MIT
#include "primal/visit_orders.h"

#include <gtest/gtest.h>

#include <set>

#include "crowd.h"
#include "sequencing/cost_matrix.h"
#include "sequencing/k_best_sequences.h"
#include "tests/support/clocks.h"
#include "tests/support/instances.h"

namespace grove::detail {
namespace visit_orders_test {

using testing::instance_of;

TEST(CheapestOrders, AreCheapest) {
  const Instance instance = testing::random_crowd({.agents = 8, .tasks = 25}, 5);
  const Limits limits;
  const Problem problem(instance, limits);
  const auto orders = *cheapest_orders(problem, limits);
  ASSERT_EQ(orders.size(), 8u);
  for (AgentIndex agent = 0; agent < 8; ++agent) {
    const CostMatrix matrix = cost_matrix(instance, agent, problem.distances);
    KBestSequences best(make_rtsp_solver(RtspBackend::kAuto, matrix, limits), matrix, limits);
    EXPECT_EQ(sequence_cost(matrix, orders[agent]), best.resolve(0, kNever));
  }
}

TEST(CheapestOrders, AgentsWithoutADestinationEndOnDifferentStops) {
  const Instance instance = instance_of({"......"}, {{{0, 0}, {}, {{1, 0}, {4, 0}, {5, 0}}},
                                                     {{2, 0}, {}, {{4, 0}, {5, 0}}},
                                                     {{3, 0}, {}, {{5, 0}}}});
  const Problem problem(instance, Limits());
  const auto orders = *cheapest_orders(problem, Limits());
  std::set<Cell> ends;
  for (AgentIndex agent = 0; agent < 3; ++agent) {
    const auto& tasks = instance.agent(agent).tasks;
    ASSERT_EQ(orders[agent].size(), tasks.size());
    EXPECT_EQ(std::set(orders[agent].begin(), orders[agent].end()).size(), tasks.size());
    ends.insert(instance.task(tasks[orders[agent].back()]).cell);
  }
  EXPECT_EQ(ends.size(), 3u);
}

TEST(CheapestOrders, NoAgentEndsOnAnothersDestination) {
  const Instance instance =
      instance_of({"......"}, {{{0, 0}, {}, {{1, 0}, {4, 0}}}, {{2, 0}, Position{4, 0}}});
  const Problem problem(instance, Limits());
  EXPECT_EQ((*cheapest_orders(problem, Limits()))[0], (Sequence{1, 0}));
}

TEST(CheapestOrders, AreNulloptAtALimit) {
  const Instance instance = instance_of({"..."}, {{{0, 0}, {}, {{1, 0}, {2, 0}}}});
  const Problem problem(instance, Limits());
  Limits over;
  over.set_deadline(testing::kPast);
  EXPECT_FALSE(cheapest_orders(problem, over));
}

}  // namespace visit_orders_test
}  // namespace grove::detail
