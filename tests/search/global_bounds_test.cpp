// SPDX-License-Identifier: MIT
#include "search/global_bounds.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/support/instances.h"

namespace grove::detail {
namespace global_bounds_test {

// One agent in a corridor. The straight path costs 4, and each wait adds 1.
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
  GlobalBounds bounds(instance(), Omega());
  EXPECT_TRUE(bounds.post(plan_of_cost(7)));
  EXPECT_FALSE(bounds.post(plan_of_cost(7)));
  EXPECT_TRUE(bounds.post(plan_of_cost(5)));
  EXPECT_FALSE(bounds.post(plan_of_cost(6)));
  EXPECT_EQ(bounds.incumbent_cost(), 5);
}

TEST(GlobalBounds, RefusesWrongPlans) {
  GlobalBounds bounds(instance(), Omega());
  Plan jump = plan_of_cost(4);
  jump.agents[0].path[2] = 0;
  EXPECT_THROW(bounds.post(jump), std::logic_error);
  Plan cheap = plan_of_cost(6);
  cheap.cost = 5;
  EXPECT_THROW(bounds.post(cheap), std::logic_error);
  EXPECT_FALSE(bounds.incumbent_cost());
}

TEST(GlobalBounds, LowerBoundIsTheLeastOfAllAndNeverFalls) {
  GlobalBounds bounds(instance(), Omega());
  EXPECT_EQ(bounds.lower_bound(), 0);
  bounds.update(6, 4);
  EXPECT_EQ(bounds.lower_bound(), 4);
  bounds.update(3, 9);
  EXPECT_EQ(bounds.lower_bound(), 4);
  bounds.post(plan_of_cost(5));
  bounds.update(8, 9);
  EXPECT_EQ(bounds.lower_bound(), 5);
}

TEST(GlobalBounds, FinishesAtOmegaInIntegers) {
  GlobalBounds bounds(instance(), Omega::parse("0.1"));
  bounds.post(plan_of_cost(11));
  bounds.update(9, 20);
  EXPECT_FALSE(bounds.finished());
  bounds.update(10, 20);
  EXPECT_TRUE(bounds.finished());
}

TEST(GlobalBounds, FinishesWithoutAPlanOnlyWhenNothingIsLeft) {
  GlobalBounds bounds(instance(), Omega::infinite());
  bounds.update(100, kInfiniteCost);
  EXPECT_FALSE(bounds.finished());
  EXPECT_FALSE(bounds.proven_infeasible());
  bounds.update(kInfiniteCost, kInfiniteCost);
  EXPECT_TRUE(bounds.finished());
  EXPECT_TRUE(bounds.proven_infeasible());
}

TEST(GlobalBounds, PlanIsOptimalWhenNothingIsLeft) {
  GlobalBounds bounds(instance(), Omega());
  bounds.post(plan_of_cost(6));
  bounds.update(kInfiniteCost, kInfiniteCost);
  EXPECT_TRUE(bounds.finished());
  EXPECT_FALSE(bounds.proven_infeasible());
  EXPECT_EQ(bounds.lower_bound(), 6);
}

TEST(GlobalBounds, PrunesNodesThatCannotBeCheaper) {
  GlobalBounds bounds(instance(), Omega::parse("0.1"));
  EXPECT_FALSE(bounds.prunes(1000));
  bounds.post(plan_of_cost(6));
  EXPECT_TRUE(bounds.prunes(6));
  EXPECT_FALSE(bounds.prunes(5));
}

TEST(GlobalBounds, NeedsNewTreeAsInAlgorithm4) {
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

}  // namespace global_bounds_test
}  // namespace grove::detail
