// SPDX-License-Identifier: MIT
#include "primal/traffic_guided_lacam.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "crowd.h"
#include "primal/lacam_with_restarts.h"
#include "primal/visit_orders.h"
#include "tests/fuzz/random_instance.h"
#include "tests/support/clocks.h"
#include "tests/support/first_violation.h"
#include "tests/support/instances.h"
#include "tests/support/sanitizers.h"

namespace grove::detail {
namespace traffic_guided_lacam_test {

using testing::Crowd;
using testing::first_violation;
using testing::instance_of;
using testing::random_crowd;
using Outcome = TrafficGuidedLacam::Outcome;

// A LaCAM plan, and a guided search to which the traffic of this plan was added.
struct Trial {
  explicit Trial(const Instance& the_instance, std::uint64_t seed = 0)
      : instance(the_instance),
        problem(instance, limits),
        orders(*cheapest_orders(problem, limits)),
        guided(problem, orders, 10, seed, tuning) {
    LacamWithRestarts search(problem, orders, seed);
    if (search.run(limits, 20'000) != LacamWithRestarts::Outcome::kFound) return;
    first = search.plan();
    guided.learn(*first);
  }

  // Runs until the end of the round.
  Outcome run(std::int64_t slice) {
    for (;;)
      if (const Outcome outcome = guided.run(limits, slice); outcome != Outcome::kWorking)
        return outcome;
  }

  Limits limits;
  const Tuning tuning;
  const Instance& instance;
  Problem problem;
  std::vector<Sequence> orders;
  TrafficGuidedLacam guided;
  std::optional<Plan> first;
};

// Returns the cost of the plan of each round (-1: no plan), after checking the plans.
std::vector<Cost> costs(Trial& trial, int rounds, std::int64_t slice = 4000) {
  std::vector<Cost> result;
  for (int round = 0; round < rounds; ++round) {
    if (trial.run(slice) != Outcome::kFound) {
      result.push_back(-1);
      continue;
    }
    EXPECT_EQ(first_violation(trial.instance, trial.guided.plan()), "");
    result.push_back(trial.guided.plan().cost);
    trial.guided.learn(trial.guided.plan());
  }
  return result;
}

class GuidedDenseInstances : public ::testing::TestWithParam<Crowd> {};

TEST_P(GuidedDenseInstances, GetValidPlansOfLowerMeanCost) {
  double first = 0;
  double best = 0;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const Instance instance = random_crowd(GetParam(), seed);
    Trial trial(instance, seed);
    if (!trial.first) continue;
    Cost least = trial.first->cost;
    for (const Cost cost : costs(trial, 6))
      if (cost >= 0) least = std::min(least, cost);
    first += static_cast<double>(trial.first->cost);
    best += static_cast<double>(least);
  }
  ASSERT_GT(first, 0);
  EXPECT_LT(best, 0.95 * first);
}

INSTANTIATE_TEST_SUITE_P(Kinds, GuidedDenseInstances,
                         ::testing::Values(Crowd{.size = 16, .agents = 80, .tasks = 0},
                                           Crowd{.agents = 50, .tasks = 50},
                                           Crowd{.agents = 40, .tasks = 60, .no_destination = 40}));

// Tiny grids, agents with and without a destination, and shared tasks.
TEST(TrafficGuidedLacam, EveryPlanOfTinyInstancesIsValid) {
  int found = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Instance instance = fuzz::random_instance(seed).build();
    if (!instance.may_follow()) continue;
    Trial trial(instance, seed);
    if (!trial.first) continue;
    for (const Cost cost : costs(trial, 2)) found += cost >= 0;
    if (HasFailure()) return;
  }
  EXPECT_GT(found, 300);
}

TEST(TrafficGuidedLacam, DoesNotDependOnTheSlices) {
  const Instance instance = random_crowd({.agents = 50, .tasks = 50}, 1);
  Trial whole(instance, 7);
  Trial sliced(instance, 7);
  ASSERT_TRUE(whole.first);
  EXPECT_EQ(costs(whole, 5, 1'000'000'000), costs(sliced, 5, 1));
  EXPECT_EQ(whole.guided.work(), sliced.guided.work());
  EXPECT_EQ(whole.guided.joint_steps(), sliced.guided.joint_steps());
}

TEST(TrafficGuidedLacam, StopsAtADeadlineAndResumesAfterwards) {
  const Instance instance = random_crowd({.agents = 50, .tasks = 50}, 2);
  Trial whole(instance);
  Trial stopped(instance);
  ASSERT_TRUE(whole.first);
  Limits past;
  past.set_deadline(testing::kPast);
  EXPECT_EQ(stopped.guided.run(past, 1000), Outcome::kStopped);
  EXPECT_EQ(costs(whole, 3), costs(stopped, 3));
}

TEST(TrafficGuidedLacam, StopsBeforeTheMemoryLimitIsReached) {
#ifdef GROVE_SANITIZERS_MEMORY
  GTEST_SKIP() << "the sanitizer's own memory fills the limit";
#endif
  const Instance instance = random_crowd({.agents = 50, .tasks = 50}, 3);
  Trial trial(instance);
  ASSERT_TRUE(trial.first);
  Limits limits;
  limits.set_memory_limit(resident_bytes() + (std::size_t{1} << 20));
  EXPECT_EQ(trial.guided.run(limits, 1'000'000), Outcome::kStopped);
  EXPECT_EQ(limits.reason(), StopReason::kNone);
}

// An agent reaches its goal even if its guide does not lead there.
TEST(Lacam, FindsAPlanDespiteAUselessGuide) {
  const Instance instance =
      instance_of({"....", "...."},
                  {{{0, 0}, Position{3, 0}}, {{3, 0}, Position{0, 0}}, {{0, 1}, Position{2, 1}}});
  const Limits limits;
  const Problem problem(instance, limits);
  const DistanceField nowhere(static_cast<std::size_t>(instance.world().state_count()), 1);
  const LegFields guide{
      {}, std::vector(static_cast<std::size_t>(instance.agent_count()), DistanceView(nowhere))};
  Lacam search(problem, *cheapest_orders(problem, limits), 0, &guide);
  std::int64_t steps = 20'000;
  ASSERT_EQ(search.run(limits, steps), Lacam::Outcome::kFound);
  EXPECT_EQ(first_violation(instance, *search.plan()), "");
}

}  // namespace traffic_guided_lacam_test
}  // namespace grove::detail
