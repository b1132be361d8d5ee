// SPDX-License-Identifier: MIT
#include "search/global_bounds.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/support/instances.h"

namespace grove::detail {
namespace gate_test {

// One agent in a corridor: walking straight costs 4, each wait one more.
const Instance& instance() {
  static const Instance kInstance = testing::instance_of({"....."}, {{{0, 0}, Position{4, 0}}});
  return kInstance;
}

Plan plan_of_cost(Time cost) {
  Path path(static_cast<std::size_t>(cost - 4), 0);
  for (Cell cell = 0; cell <= 4; ++cell) path.push_back(cell);
  return {cost, {{cost, {}, path}}};
}

TEST(GlobalBounds, KeepsTheCheapestPlan) {
  GlobalBounds gate(instance(), Omega());
  EXPECT_TRUE(gate.post(plan_of_cost(7)));
  EXPECT_FALSE(gate.post(plan_of_cost(7)));
  EXPECT_TRUE(gate.post(plan_of_cost(5)));
  EXPECT_FALSE(gate.post(plan_of_cost(6)));
  EXPECT_EQ(gate.incumbent_cost(), 5);
}

TEST(GlobalBounds, RefusesWrongPlans) {
  GlobalBounds gate(instance(), Omega());
  Plan jump = plan_of_cost(4);
  jump.agents[0].path[2] = 0;
  EXPECT_THROW(gate.post(jump), std::logic_error);
  Plan cheap = plan_of_cost(6);
  cheap.cost = 5;
  EXPECT_THROW(gate.post(cheap), std::logic_error);
  EXPECT_FALSE(gate.incumbent_cost());
}

TEST(GlobalBounds, LowerBoundIsTheLeastOfAllAndNeverFalls) {
  GlobalBounds gate(instance(), Omega());
  EXPECT_EQ(gate.lower_bound(), 0);
  gate.update(6, 4);
  EXPECT_EQ(gate.lower_bound(), 4);
  gate.update(3, 9);
  EXPECT_EQ(gate.lower_bound(), 4);
  gate.post(plan_of_cost(5));
  gate.update(8, 9);
  EXPECT_EQ(gate.lower_bound(), 5);
}

TEST(GlobalBounds, FinishesAtOmegaInIntegers) {
  GlobalBounds gate(instance(), Omega::parse("0.1"));
  gate.post(plan_of_cost(11));
  gate.update(9, 20);
  EXPECT_FALSE(gate.finished());
  gate.update(10, 20);
  EXPECT_TRUE(gate.finished());
}

TEST(GlobalBounds, WithoutAPlanItFinishesOnlyWhenNothingIsLeft) {
  GlobalBounds gate(instance(), Omega::infinite());
  gate.update(100, kInfiniteCost);
  EXPECT_FALSE(gate.finished());
  EXPECT_FALSE(gate.proven_infeasible());
  gate.update(kInfiniteCost, kInfiniteCost);
  EXPECT_TRUE(gate.finished());
  EXPECT_TRUE(gate.proven_infeasible());
}

TEST(GlobalBounds, WithAPlanAndNothingLeftThePlanIsOptimal) {
  GlobalBounds gate(instance(), Omega());
  gate.post(plan_of_cost(6));
  gate.update(kInfiniteCost, kInfiniteCost);
  EXPECT_TRUE(gate.finished());
  EXPECT_FALSE(gate.proven_infeasible());
  EXPECT_EQ(gate.lower_bound(), 6);
}

TEST(GlobalBounds, PrunesWhatCannotBeCheaper) {
  GlobalBounds gate(instance(), Omega::parse("0.1"));
  EXPECT_FALSE(gate.prunes(1000));
  gate.post(plan_of_cost(6));
  EXPECT_TRUE(gate.prunes(6));
  EXPECT_FALSE(gate.prunes(5));
}

TEST(GlobalBounds, AsksForTreesAsAlgorithm4Does) {
  const GlobalBounds exact(instance(), Omega());
  EXPECT_TRUE(exact.needs_new_tree(kInfiniteCost, std::nullopt));
  EXPECT_FALSE(exact.needs_new_tree(10, 10));
  EXPECT_TRUE(exact.needs_new_tree(11, 10));
  EXPECT_TRUE(exact.needs_new_tree(kInfiniteCost, 10));

  const GlobalBounds bounded(instance(), Omega::parse("0.1"));
  EXPECT_FALSE(bounded.needs_new_tree(11, 10));
  EXPECT_TRUE(bounded.needs_new_tree(12, 10));

  const GlobalBounds sequential(instance(), Omega::infinite());
  EXPECT_TRUE(sequential.needs_new_tree(kInfiniteCost, std::nullopt));
  EXPECT_FALSE(sequential.needs_new_tree(1000, 10));
  EXPECT_FALSE(sequential.needs_new_tree(kInfiniteCost, 10));
}

}  // namespace gate_test
}  // namespace grove::detail
