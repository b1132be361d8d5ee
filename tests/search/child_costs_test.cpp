// SPDX-License-Identifier: MIT
#include "search/child_costs.h"

#include <gtest/gtest.h>

#include "tests/search/root_fixture.h"

namespace grove::detail {
namespace child_costs_test {

using testing::RootFixture;
using Outcome = ChildCosts::Outcome;

// Path lengths of the agent: 4 through the open door at time 2; 12 if the door is blocked up to
// time 9, so that the agent passes it at time 10.
constexpr Time kFree = 4;
constexpr Time kBlocked = 12;

class ChildCostsTest : public ::testing::Test {
 protected:
  Time cost(Time cutoff, std::int64_t label_limit = PathQuery::kUnlimited) {
    Time cost = -1;
    EXPECT_EQ(
        child_costs_.cost(node_.view, 0, door_is_blocked_, cutoff, label_limit, node_.limits, cost),
        Outcome::kDone);
    return cost;
  }
  Cost increase(Cost slack) {
    Cost increase = -1;
    EXPECT_EQ(
        child_costs_.increase(node_.view, {0, door_is_blocked_}, slack, node_.limits, increase),
        Outcome::kDone);
    return increase;
  }

  RootFixture node_{{"..@..", ".....", "..@.."}, {{{0, 1}, Position{4, 1}}}};
  const Constraint door_is_blocked_{node_.instance.grid().cell({2, 1}), kNoPlace, 0, 9};
  ChildCosts child_costs_{node_.planner, node_.memory, PathQuery::kUnlimited};
};

TEST_F(ChildCostsTest, CostIsExactWithinTheCutoff) {
  EXPECT_EQ(cost(kNever - 1), kBlocked);
  EXPECT_EQ(cost(kBlocked), kBlocked);
  EXPECT_EQ(child_costs_.known(), 1);
}

// A result above the cutoff is only a lower bound on the cost. It is cached, and later queries with
// other cutoffs use it.
TEST_F(ChildCostsTest, CostAboveTheCutoffIsALowerBound) {
  for (Time cutoff = kFree; cutoff < kBlocked; ++cutoff) {
    const Time known = cost(cutoff);
    EXPECT_GT(known, cutoff);
    EXPECT_LE(known, kBlocked);
  }
  EXPECT_EQ(cost(kBlocked), kBlocked);
}

TEST_F(ChildCostsTest, CostOneAboveTheCutoffIsExact) {
  EXPECT_EQ(cost(kBlocked - 1), kBlocked);
}

TEST_F(ChildCostsTest, IncreaseIsExactWithinTheSlackElseInfinite) {
  EXPECT_EQ(increase(kBlocked - kFree - 1), kInfiniteCost);
  EXPECT_EQ(increase(kBlocked - kFree), kBlocked - kFree);
}

}  // namespace child_costs_test
}  // namespace grove::detail
