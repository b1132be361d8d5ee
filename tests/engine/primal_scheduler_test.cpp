// SPDX-License-Identifier: MIT
// Tests the shares of tree search and primal search, according to the rule at the head of
// primal_scheduler.cpp.
#include "engine/primal_scheduler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "tests/primal/crowd.h"
#include "tests/support/instances.h"

namespace grove::detail {
namespace primal_scheduler_test {

constexpr std::int64_t kLong = 6'400'000;  // tree effort at which the cap reaches its full value

// An instance with its primal search. With Techniques() there is no LaCAM, so expects_plan() is
// always false.
struct Setting {
  explicit Setting(Instance the_instance, Techniques techniques = Techniques())
      : instance(std::move(the_instance)), primal(problem, stops, 1, techniques) {}

  Limits limits;
  Instance instance;
  Problem problem{instance, limits};
  AgentStopsCache stops{instance, problem.distances};
  PrimalSearch primal;
};

Instance dense_instance() {
  return testing::random_crowd({.size = 8, .obstacles = 10, .agents = 12, .tasks = 12}, 1);
}

// Returns a scheduler with a long tree, after the primal search has used up its credit.
PrimalScheduler after_credit_is_spent(const PrimalSearch& primal, int agents) {
  PrimalScheduler scheduler(agents, Tuning());
  scheduler.add_tree_work(kLong);
  scheduler.add_primal_work(primal, 8 * kLong);
  return scheduler;
}

// Returns whether the primal search is still due after `tree` units of tree effort followed by
// `work` units of primal effort.
bool is_due_after(PrimalScheduler scheduler, const PrimalSearch& primal, std::int64_t tree,
                  std::int64_t work) {
  scheduler.add_tree_work(tree);
  scheduler.add_primal_work(primal, work);
  return scheduler.due(primal);
}

void expect_ratio(const PrimalScheduler& scheduler, const PrimalSearch& primal, double ratio) {
  const auto max_work = static_cast<std::int64_t>(std::llround(1e6 * ratio));
  EXPECT_TRUE(is_due_after(scheduler, primal, 1'000'000, max_work - 1)) << ratio;
  EXPECT_FALSE(is_due_after(scheduler, primal, 1'000'000, max_work + 1)) << ratio;
}

TEST(PrimalScheduler, StartsThePrimalSearchAfterSomeTreeWork) {
  PrimalScheduler scheduler(2, Tuning());
  scheduler.add_tree_work(1999);
  EXPECT_FALSE(scheduler.may_begin());
  scheduler.add_tree_work(1);
  EXPECT_TRUE(scheduler.may_begin());
}

TEST(PrimalScheduler, CapGrowsFromAQuarterWithTheTreeWork) {
  const Setting s(dense_instance());
  const PrimalScheduler scheduler(12, Tuning());
  EXPECT_TRUE(is_due_after(scheduler, s.primal, 2000, 500));
  EXPECT_FALSE(is_due_after(scheduler, s.primal, 2000, 501));
  EXPECT_TRUE(is_due_after(scheduler, s.primal, kLong / 32, kLong / 128));
  EXPECT_FALSE(is_due_after(scheduler, s.primal, kLong / 32, kLong / 128 + 1));
  EXPECT_TRUE(is_due_after(scheduler, s.primal, kLong / 2, 2 * kLong));
  EXPECT_FALSE(is_due_after(scheduler, s.primal, kLong / 2, 2 * kLong + 1));
}

TEST(PrimalScheduler, RatioWithoutAPlanFallsAfterManyFailures) {
  // The agents cannot pass each other; the primal search does not detect this.
  Setting s(testing::instance_of({"......"}, {{{0, 0}, Position{5, 0}}, {{5, 0}, Position{0, 0}}}));
  expect_ratio(after_credit_is_spent(s.primal, 2), s.primal, 8);
  for (int i = 0; i < 10'000 && s.primal.counts().attempts <= 4; ++i) s.primal.step(s.limits);
  ASSERT_GT(s.primal.counts().attempts, 4);
  expect_ratio(after_credit_is_spent(s.primal, 2), s.primal, 1);
}

TEST(PrimalScheduler, RatioWithAPlanFollowsItsSuccess) {
  Setting s(dense_instance());
  double min_x = 1;
  double max_x = 0;
  for (int i = 0; i < 400; ++i) {
    s.primal.step(s.limits);
    if (!s.primal.best_cost()) continue;
    ASSERT_FALSE(s.primal.optimal());
    const double x =
        static_cast<double>(s.primal.work_at_last_plan()) / static_cast<double>(s.primal.work());
    min_x = std::min(min_x, x);
    max_x = std::max(max_x, x);
    expect_ratio(after_credit_is_spent(s.primal, 12), s.primal,
                 std::clamp(8 * x * x * x, 1.0 / 32, 8.0));
  }
  EXPECT_LT(min_x, 0.2) << "too successful to be a test";
  EXPECT_EQ(max_x, 1);
}

TEST(PrimalScheduler, RatioIsAtLeastOneWhileTreesAreDominated) {
  // The agents cannot pass each other; the primal search does not detect this and fails repeatedly.
  Setting s(testing::instance_of({"......"}, {{{0, 0}, Position{5, 0}}, {{5, 0}, Position{0, 0}}}));
  for (int i = 0; i < 10'000 && s.primal.counts().attempts <= 4; ++i) s.primal.step(s.limits);
  Tuning tuning;
  tuning.primal_share_after_failures = 0.125;
  PrimalScheduler scheduler(2, tuning);
  scheduler.add_tree_work(kLong);
  scheduler.add_primal_work(s.primal, 8 * kLong);
  PrimalScheduler dominated = scheduler;
  dominated.add_tree_work(1'000'000, {.is_dominated = true});
  dominated.add_primal_work(s.primal, 999'999);
  EXPECT_TRUE(dominated.due(s.primal));
  scheduler.add_tree_work(1'000'000);
  scheduler.add_primal_work(s.primal, 999'999);
  EXPECT_FALSE(scheduler.due(s.primal));
}

TEST(PrimalScheduler, CapIsFullForAShortTreeWhileTheGapIsLarge) {
  Setting s(dense_instance());
  while (!s.primal.best_cost()) s.primal.step(s.limits);
  PrimalScheduler scheduler(12, Tuning());
  scheduler.add_primal_work(s.primal, 0);  // x = 1, as if the primal search had just found a plan
  PrimalScheduler large_gap = scheduler;
  scheduler.add_tree_work(2000);
  scheduler.add_primal_work(s.primal, 1000);
  EXPECT_FALSE(scheduler.due(s.primal));
  large_gap.add_tree_work(2000, {.gap_is_large = true});
  large_gap.add_primal_work(s.primal, 15'000);
  EXPECT_TRUE(large_gap.due(s.primal));
}

TEST(PrimalScheduler, RatioIsAtLeastOneWhileTheGapIsLarge) {
  Setting s(dense_instance());
  while (!s.primal.best_cost()) s.primal.step(s.limits);
  while (s.primal.work() < 4 * s.primal.work_at_last_plan() && !s.primal.optimal())
    s.primal.step(s.limits);
  ASSERT_FALSE(s.primal.optimal());
  PrimalScheduler scheduler = after_credit_is_spent(s.primal, 12);
  PrimalScheduler large_gap = scheduler;
  scheduler.add_tree_work(1'000'000);
  large_gap.add_tree_work(1'000'000, {.gap_is_large = true});
  for (PrimalScheduler* each : {&scheduler, &large_gap}) each->add_primal_work(s.primal, 999'999);
  EXPECT_TRUE(large_gap.due(s.primal));
  EXPECT_FALSE(scheduler.due(s.primal));
}

TEST(PrimalScheduler, SearchThatExpectsAPlanIsDueAndNotCharged) {
  const Setting s(dense_instance());
  const Setting expecting(dense_instance(), Techniques::defaults());
  ASSERT_TRUE(expecting.primal.expects_plan());
  PrimalScheduler scheduler = after_credit_is_spent(s.primal, 12);
  scheduler.add_primal_work(expecting.primal, kLong);
  EXPECT_TRUE(scheduler.due(s.primal)) << "nothing was charged";
  scheduler.add_primal_work(s.primal, 1);
  EXPECT_FALSE(scheduler.due(s.primal));
  EXPECT_TRUE(scheduler.due(expecting.primal));
}

TEST(PrimalScheduler, OptimalSearchIsNeverDue) {
  Setting s(testing::instance_of({"...."}, {{{0, 0}, Position{3, 0}}}));
  PrimalScheduler scheduler(1, Tuning());
  scheduler.add_tree_work(kLong);
  EXPECT_TRUE(scheduler.due(s.primal));
  s.primal.step(s.limits);
  ASSERT_TRUE(s.primal.optimal());
  EXPECT_FALSE(scheduler.due(s.primal));
}

}  // namespace primal_scheduler_test
}  // namespace grove::detail
