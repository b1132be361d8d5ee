// SPDX-License-Identifier: MIT
// How work is divided between the tree and the primal search, in figures. The rule is at the head
// of primal_scheduler.cpp.
#include "engine/primal_scheduler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "tests/primal/crowd.h"
#include "tests/support/instances.h"

namespace grove::detail {
namespace primal_share_test {

constexpr std::int64_t kLong = 6'400'000;  // work of a tree that is long

// A primal search of an instance; one with Techniques() never says that it expects a plan.
struct Setting {
  explicit Setting(Instance the_instance, Techniques techniques = Techniques())
      : instance(std::move(the_instance)), primal(problem, stops, 1, techniques) {}

  Limits limits;
  Instance instance;
  Problem problem{instance, limits};
  AgentStopsCache stops{instance, problem.distances};
  PrimalSearch primal;
};

Instance crowd() {
  return testing::random_crowd({.size = 8, .obstacles = 10, .agents = 12, .tasks = 12}, 1);
}

// Of a long tree, after the primal search has used up its credit.
PrimalScheduler settled(const PrimalSearch& primal, int agents) {
  PrimalScheduler share(agents, Tuning());
  share.add_tree_work(kLong);
  share.add_primal_work(primal, 8 * kLong);
  return share;
}

// Is the primal search still due when it has done so much after the tree has done that?
bool may_do(PrimalScheduler share, const PrimalSearch& primal, std::int64_t tree,
            std::int64_t work) {
  share.add_tree_work(tree);
  share.add_primal_work(primal, work);
  return share.due(primal);
}

void expect_ratio(const PrimalScheduler& share, const PrimalSearch& primal, double ratio) {
  const auto most = static_cast<std::int64_t>(std::llround(1e6 * ratio));
  EXPECT_TRUE(may_do(share, primal, 1'000'000, most - 1)) << ratio;
  EXPECT_FALSE(may_do(share, primal, 1'000'000, most + 1)) << ratio;
}

TEST(PrimalScheduler, TheTreeBegins) {
  PrimalScheduler share(2, Tuning());
  share.add_tree_work(1999);
  EXPECT_FALSE(share.may_begin());
  share.add_tree_work(1);
  EXPECT_TRUE(share.may_begin());
}

TEST(PrimalScheduler, WhileTheTreeIsShortItLeavesAQuarterAndThenEverMore) {
  const Setting s(crowd());
  const PrimalScheduler share(12, Tuning());
  EXPECT_TRUE(may_do(share, s.primal, 2000, 500));
  EXPECT_FALSE(may_do(share, s.primal, 2000, 501));
  EXPECT_TRUE(may_do(share, s.primal, kLong / 32, kLong / 128));
  EXPECT_FALSE(may_do(share, s.primal, kLong / 32, kLong / 128 + 1));
  EXPECT_TRUE(may_do(share, s.primal, kLong / 2, 2 * kLong));
  EXPECT_FALSE(may_do(share, s.primal, kLong / 2, 2 * kLong + 1));
}

TEST(PrimalScheduler, WithoutAPlanItIsEightTimesTheTreesUntilItHasFailedOften) {
  // They cannot pass each other, which the primal search does not know.
  Setting s(testing::instance_of({"......"}, {{{0, 0}, Position{5, 0}}, {{5, 0}, Position{0, 0}}}));
  expect_ratio(settled(s.primal, 2), s.primal, 8);
  for (int i = 0; i < 10'000 && s.primal.counts().attempts <= 4; ++i) s.primal.step(s.limits);
  ASSERT_GT(s.primal.counts().attempts, 4);
  expect_ratio(settled(s.primal, 2), s.primal, 1);
}

TEST(PrimalScheduler, WithAPlanItFollowsItsSuccess) {
  Setting s(crowd());
  double least = 1;
  double greatest = 0;
  for (int i = 0; i < 400; ++i) {
    s.primal.step(s.limits);
    if (!s.primal.best_cost()) continue;
    ASSERT_FALSE(s.primal.optimal());
    const double x =
        static_cast<double>(s.primal.work_at_last_plan()) / static_cast<double>(s.primal.work());
    least = std::min(least, x);
    greatest = std::max(greatest, x);
    expect_ratio(settled(s.primal, 12), s.primal, std::clamp(8 * x * x * x, 1.0 / 32, 8.0));
  }
  EXPECT_LT(least, 0.2) << "too successful to be a test";
  EXPECT_EQ(greatest, 1);
}

TEST(PrimalScheduler, WhileMoreIsProvenBesideTheTreeItHasAsMuchAtLeast) {
  // They cannot pass each other, which the primal search does not know: it has failed often.
  Setting s(testing::instance_of({"......"}, {{{0, 0}, Position{5, 0}}, {{5, 0}, Position{0, 0}}}));
  for (int i = 0; i < 10'000 && s.primal.counts().attempts <= 4; ++i) s.primal.step(s.limits);
  Tuning tuning;
  tuning.primal_share_after_failures = 0.125;
  PrimalScheduler share(2, tuning);
  share.add_tree_work(kLong);
  share.add_primal_work(s.primal, 8 * kLong);
  PrimalScheduler beside = share;
  beside.add_tree_work(1'000'000, {.is_behind = true});
  beside.add_primal_work(s.primal, 999'999);
  EXPECT_TRUE(beside.due(s.primal));
  share.add_tree_work(1'000'000);
  share.add_primal_work(s.primal, 999'999);
  EXPECT_FALSE(share.due(s.primal));
}

TEST(PrimalScheduler, WhileThePlanIsFarFromWhatIsProvenAShortTreeLeavesItTheMost) {
  Setting s(crowd());
  while (!s.primal.best_cost()) s.primal.step(s.limits);
  PrimalScheduler share(12, Tuning());
  share.add_primal_work(s.primal, 0);  // it has just found a plan
  PrimalScheduler far = share;
  share.add_tree_work(2000);
  share.add_primal_work(s.primal, 1000);
  EXPECT_FALSE(share.due(s.primal));
  far.add_tree_work(2000, {.gap_is_large = true});
  far.add_primal_work(s.primal, 15'000);
  EXPECT_TRUE(far.due(s.primal));
}

TEST(PrimalScheduler, WhileThePlanIsFarWorkInVainLeavesItAsMuchAsTheTree) {
  Setting s(crowd());
  while (!s.primal.best_cost()) s.primal.step(s.limits);
  while (s.primal.work() < 4 * s.primal.work_at_last_plan() && !s.primal.optimal())
    s.primal.step(s.limits);
  ASSERT_FALSE(s.primal.optimal());
  PrimalScheduler share = settled(s.primal, 12);
  PrimalScheduler far = share;
  share.add_tree_work(1'000'000);
  far.add_tree_work(1'000'000, {.gap_is_large = true});
  for (PrimalScheduler* each : {&share, &far}) each->add_primal_work(s.primal, 999'999);
  EXPECT_TRUE(far.due(s.primal));
  EXPECT_FALSE(share.due(s.primal));
}

TEST(PrimalScheduler, ASearchThatExpectsAPlanIsDueAndNotCharged) {
  const Setting s(crowd());
  const Setting expecting(crowd(), Techniques::defaults());
  ASSERT_TRUE(expecting.primal.expects_plan());
  PrimalScheduler share = settled(s.primal, 12);
  share.add_primal_work(expecting.primal, kLong);
  EXPECT_TRUE(share.due(s.primal)) << "nothing was charged";
  share.add_primal_work(s.primal, 1);
  EXPECT_FALSE(share.due(s.primal));
  EXPECT_TRUE(share.due(expecting.primal));
}

TEST(PrimalScheduler, ASearchThatHasNothingLeftToDoIsNeverDue) {
  Setting s(testing::instance_of({"...."}, {{{0, 0}, Position{3, 0}}}));
  PrimalScheduler share(1, Tuning());
  share.add_tree_work(kLong);
  EXPECT_TRUE(share.due(s.primal));
  s.primal.step(s.limits);
  ASSERT_TRUE(s.primal.optimal());
  EXPECT_FALSE(share.due(s.primal));
}

}  // namespace primal_share_test
}  // namespace grove::detail
