// SPDX-License-Identifier: MIT
#include "execution/execution_trace.h"

#include <gtest/gtest.h>

#include <chrono>

#include "engine/solve.h"
#include "model/check.h"
#include "tests/execution/collisions.h"
#include "tests/execution/delays.h"
#include "tests/fuzz/random_instance.h"
#include "tests/support/clocks.h"

namespace grove::detail {
namespace execution_trace_test {

using testing::collision;
using testing::Delays;

std::optional<Plan> plan_of(const Instance& instance) {
  SolveOptions options;
  options.omega = Omega::infinite();
  const testing::ClockReadingLimit limits(10'000);
  return solve(instance, options, limits).plan;
}

std::vector<State> starts_of(const Instance& instance) {
  std::vector<State> starts;
  for (const Agent& agent : instance.agents()) starts.push_back(agent.start);
  return starts;
}

TEST(ExecutionTrace, AllRobotsArriveWithoutCollisions) {
  int drives = 0;
  for (std::uint64_t seed = 1000; seed < 1150; ++seed) {
    const Instance instance = fuzz::random_world(seed).build();
    const auto plan = plan_of(instance);
    if (!plan) continue;
    const ActionDependencyGraph order(instance, *plan);
    for (std::uint64_t schedule = 0; schedule < 50; ++schedule, ++drives) {
      const ExecutionTrace executed = simulate(order, Delays(order, schedule));
      ASSERT_EQ(collision(instance.world(), order, executed, starts_of(instance)), "") << seed;
      ASSERT_TRUE(blocked_robots(order, executed).empty()) << seed << ", " << schedule;
      Solution solution;
      solution.plan = executed_plan(instance, *plan, order, executed);
      solution.status = status_of(solution.plan->cost, 0, solution.omega);
      const auto wrong = check(instance, solution);
      ASSERT_TRUE(wrong.empty()) << seed << ", " << schedule << ": " << wrong[0].json_pointer << " "
                                 << wrong[0].message;
    }
  }
  EXPECT_GT(drives, 3000);
}

TEST(ExecutionTrace, OnlyRobotsBehindFailedOnesAreBlocked) {
  int held_up = 0;
  for (std::uint64_t seed = 2000; seed < 2100; ++seed) {
    const Instance instance = fuzz::random_world(seed).build();
    const auto plan = plan_of(instance);
    if (!plan) continue;
    const ActionDependencyGraph order(instance, *plan);
    for (std::uint64_t schedule = 0; schedule < 20; ++schedule) {
      Delays delays(order, schedule, true);
      const ExecutionTrace executed = simulate(order, std::ref(delays));
      ASSERT_EQ(collision(instance.world(), order, executed, starts_of(instance)), "") << seed;
      const std::vector<BlockedRobot> all = blocked_robots(order, executed);
      EXPECT_LE(delays.any_robot_fails() ? 0 : all.size(), 0u);
      bool has_failed = all.empty();
      for (const BlockedRobot& s : all) {
        ASSERT_GE(s.waits_for, 0);
        has_failed |= s.waits_for == s.agent;
        held_up += s.waits_for != s.agent ? 1 : 0;
        // The robot that a blocked robot waits for is blocked, too.
        EXPECT_TRUE(std::ranges::find(all, s.waits_for, &BlockedRobot::agent) != all.end());
      }
      EXPECT_TRUE(has_failed) << seed << ", " << schedule;
    }
  }
  EXPECT_GT(held_up, 50);
}

// Plans in which no robot enters a place in the step in which another robot leaves it.
TEST(ExecutionTrace, NominalTakesNoLongerThanPlanWithoutFollowing) {
  int without_following = 0;
  int longer = 0;
  for (std::uint64_t seed = 3000; seed < 3300; ++seed) {
    const Instance instance = fuzz::random_world(seed).build();
    const auto plan = plan_of(instance);
    if (!plan) continue;
    const ActionDependencyGraph order(instance, *plan);
    const ExecutionTrace executed = simulate_nominal(order);
    bool follows = order.rings() > 0;
    bool is_longer = false;
    for (ActionIndex a = 0; a < static_cast<ActionIndex>(order.actions().size()); ++a) {
      const Action& action = order.actions()[a];
      const ActionIndex other = order.after(a);
      follows |= other != kNoAction && order.actions()[other].begin == action.begin;
      is_longer |= executed.begin[a] > action.begin;
    }
    without_following += follows ? 0 : 1;
    longer += is_longer ? 1 : 0;
    EXPECT_FALSE(!follows && is_longer) << seed;
  }
  EXPECT_GT(without_following, 20);
  EXPECT_GT(longer, 0);
}

}  // namespace execution_trace_test
}  // namespace grove::detail
