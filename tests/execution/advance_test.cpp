// SPDX-License-Identifier: MIT
#include "execution/advance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>

#include "engine/solve.h"
#include "tests/fuzz/random_instance.h"
#include "tests/support/clocks.h"
#include "tests/support/first_violation.h"
#include "tests/support/instances.h"

namespace grove::detail {
namespace advance_test {

using testing::AgentSpec;
using testing::first_violation;
using testing::instance_of;

TEST(Advance, RemovesVisitedTasks) {
  const Instance instance =
      instance_of({"....."}, {AgentSpec{{0, 0}, Position{4, 0}, {Position{1, 0}, Position{3, 0}}}});
  const Solution solution = solve(instance, {}, Limits());
  const Remainder rest = advance(instance, *solution.plan, 2);
  ASSERT_EQ(rest.instance.task_count(), 1);
  EXPECT_EQ(rest.instance.task(0).id, instance.task(1).id);
  EXPECT_EQ(rest.instance.agent(0).start, instance.grid().cell({2, 0}));
  EXPECT_EQ(rest.plan.cost, 2);
  EXPECT_EQ(first_violation(rest.instance, rest.plan), "");
}

TEST(Advance, RemainingPlanSolvesTheRemainingInstance) {
  int moments = 0;
  for (std::uint64_t seed = 5000; seed < 5400; ++seed) {
    const Instance instance = fuzz::random_world(seed).build();
    SolveOptions options;
    options.omega = Omega::infinite();
    const testing::ClockReadingLimit limits(10'000);
    const auto plan = solve(instance, options, limits).plan;
    if (!plan) continue;
    const Time end = std::ranges::max(plan->agents, {}, &AgentPlan::cost).cost;
    for (Time time = 0; time <= end + 1; ++time, ++moments) {
      const Remainder rest = advance(instance, *plan, time);
      ASSERT_EQ(first_violation(rest.instance, rest.plan), "") << seed << " after " << time;
      EXPECT_LE(rest.plan.cost, plan->cost);
      // Advancing by `time` and then by 1 is the same as advancing by `time` + 1.
      const Remainder next = advance(rest.instance, rest.plan, 1);
      const Remainder both = advance(instance, *plan, time + 1);
      EXPECT_EQ(next.plan.cost, both.plan.cost) << seed << " after " << time;
      EXPECT_EQ(next.instance.task_count(), both.instance.task_count()) << seed;
      for (AgentIndex a = 0; a < instance.agent_count(); ++a)
        EXPECT_EQ(next.instance.pose_of(next.instance.agent(a).start),
                  both.instance.pose_of(both.instance.agent(a).start))
            << seed;
    }
    const Remainder last = advance(instance, *plan, end);
    EXPECT_EQ(last.plan.cost, 0);
  }
  EXPECT_GT(moments, 1500);
}

}  // namespace advance_test
}  // namespace grove::detail
