// SPDX-License-Identifier: MIT
#include "search/child_costs.h"

#include <gtest/gtest.h>

#include "tests/search/root_fixture.h"

namespace grove::detail {
namespace prices_test {

using testing::RootFixture;
using Outcome = ChildCosts::Outcome;

// Through the door at time 2, or when it is barred up to time 9 at time 10: 12 steps in all.
constexpr Time kFree = 4;
constexpr Time kBarred = 12;

class PricesTest : public ::testing::Test {
 protected:
  Time cost(Time cutoff, std::int64_t label_limit = PathQuery::kUnlimited) {
    Time cost = -1;
    EXPECT_EQ(prices_.cost(node_.view, 0, door_is_barred_, cutoff, label_limit, node_.limits, cost),
              Outcome::kDone);
    return cost;
  }
  Cost increase(Cost slack) {
    Cost increase = -1;
    EXPECT_EQ(prices_.increase(node_.view, {0, door_is_barred_}, slack, node_.limits, increase),
              Outcome::kDone);
    return increase;
  }

  RootFixture node_{{"..@..", ".....", "..@.."}, {{{0, 1}, Position{4, 1}}}};
  const Constraint door_is_barred_{node_.instance.grid().cell({2, 1}), kNoPlace, 0, 9};
  ChildCosts prices_{node_.planner, node_.memory, PathQuery::kUnlimited};
};

TEST_F(PricesTest, AreExactWithinTheCutoff) {
  EXPECT_EQ(cost(kNever - 1), kBarred);
  EXPECT_EQ(cost(kBarred), kBarred);
  EXPECT_EQ(prices_.known(), 1);
}

// What is above the cutoff is not exact, but never more than the truth: it is remembered, and used
// under other cutoffs.
TEST_F(PricesTest, AboveTheCutoffAreNeverMoreThanTheTruth) {
  for (Time cutoff = kFree; cutoff < kBarred; ++cutoff) {
    const Time known = cost(cutoff);
    EXPECT_GT(known, cutoff);
    EXPECT_LE(known, kBarred);
  }
  EXPECT_EQ(cost(kBarred), kBarred);
}

TEST_F(PricesTest, JustAboveTheCutoffAreTheTruth) {
  EXPECT_EQ(cost(kBarred - 1), kBarred);
}

TEST_F(PricesTest, RiseByWhatTheDemandCosts) {
  EXPECT_EQ(increase(kBarred - kFree - 1), kInfiniteCost);
  EXPECT_EQ(increase(kBarred - kFree), kBarred - kFree);
}

}  // namespace prices_test
}  // namespace grove::detail
