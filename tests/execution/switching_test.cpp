// SPDX-License-Identifier: MIT
#include "execution/switching.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>

#include "engine/solve.h"
#include "model/random.h"
#include "tests/execution/collisions.h"
#include "tests/execution/delays.h"
#include "tests/fuzz/random_instance.h"
#include "tests/support/clocks.h"
#include "tests/support/first_violation.h"
#include "tests/support/instances.h"

namespace grove::detail {
namespace switching_test {

using testing::AgentSpec;
using testing::collision;
using testing::Delays;
using testing::first_violation;
using testing::instance_of;

std::optional<Plan> plan_of(const Instance& instance) {
  SolveOptions options;
  options.omega = Omega::infinite();
  const testing::ClockReadingLimit limits(10'000);
  return solve(instance, options, limits).plan;
}

// Returns an instance with up to ten robots in a small hall with pillars.
Instance dense_instance(std::uint64_t seed) {
  Random random(seed);
  const int width = 8;
  const int height = 6;
  std::vector<bool> passable;
  for (int i = 0; i < width * height; ++i) passable.push_back(random.below(6) > 0);
  const Grid grid(width, height, passable);
  InstanceBuilder builder{Map(grid)};
  for (int tries = 0, robots = 0; tries < 60 && robots < 10; ++tries) {
    try {
      const Cell start = random.below(grid.cell_count());
      const Cell goal = random.below(grid.cell_count());
      builder.add_agent(fmt::format("r{}", robots), grid.position(start), grid.position(goal));
      ++robots;
    } catch (const InstanceError&) {  // occupied or blocked
    }
  }
  return std::move(builder).build();
}

Cost cost_of(const ActionDependencyGraph& order, const ExecutionTrace& trace) {
  Cost cost = 0;
  for (AgentIndex agent = 0; agent < order.agent_count(); ++agent)
    cost += trace.finish(order, agent);
  return cost;
}

// In the plan robot 0 crosses the path of robot 1 first, but robot 0 is delayed before the
// crossing.
TEST(Switching, RobotThatWaitsForADelayedOneGoesFirst) {
  const Instance instance =
      instance_of({"@@@.@@@", "@@@.@@@", ".......", "@@@.@@@", "@@@.@@@"},
                  {AgentSpec{{0, 2}, Position{6, 2}, {}}, AgentSpec{{3, 0}, Position{3, 4}, {}}});
  Plan plan;
  const Grid& grid = instance.grid();
  const auto path = [&](std::vector<Position> cells) {
    Path states;
    for (const Position p : cells) states.push_back(grid.cell(p));
    return states;
  };
  plan.agents.push_back(
      {6, {}, path({{0, 2}, {1, 2}, {2, 2}, {3, 2}, {4, 2}, {5, 2}, {6, 2}}), {}});
  plan.agents.push_back(
      {6, {}, path({{3, 0}, {3, 1}, {3, 1}, {3, 1}, {3, 2}, {3, 3}, {3, 4}}), {}});
  plan.cost = 12;
  ASSERT_EQ(first_violation(instance, plan), "");
  const ActionDependencyGraph order(instance, plan);
  const Duration stops = [&](ActionIndex a, Time) { return a == 0 ? 50 : 1; };
  const SwitchableTrace switched = simulate_switchable(instance.world(), plan, order, stops);
  EXPECT_EQ(switched.switches, 1);
  EXPECT_EQ(simulate(order, stops).finish(order, 1), 56);
  EXPECT_LT(switched.trace.finish(order, 1), 15);
  EXPECT_EQ(switched.trace.finish(order, 0), 55);
}

// A wrong switch would cause a deadlock, for example if the order of two robots in a corridor were
// switched once one of them is inside.
TEST(Switching, CausesNoDeadlock) {
  std::int64_t switches = 0;
  Cost fixed = 0;
  Cost switching = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const Instance instance =
        seed % 2 == 0 ? dense_instance(seed) : fuzz::random_world(seed).build();
    const auto plan = plan_of(instance);
    if (!plan) continue;
    const ActionDependencyGraph order(instance, *plan);
    std::vector<State> starts;
    for (const Agent& agent : instance.agents()) starts.push_back(agent.start);
    for (std::uint64_t schedule = 0; schedule < 20; ++schedule) {
      const Delays delays(order, schedule);
      const SwitchableTrace switched = simulate_switchable(instance.world(), *plan, order, delays,
                                                           1 + static_cast<Time>(seed % 5));
      ASSERT_EQ(collision(instance.world(), order, switched.trace, starts), "") << seed;
      ASSERT_TRUE(switched.blocked_robots.empty()) << seed << ", " << schedule;
      ASSERT_EQ(first_violation(instance, executed_plan(instance, *plan, order, switched.trace)),
                "")
          << seed;
      switches += switched.switches;
      switching += cost_of(order, switched.trace);
      fixed += cost_of(order, simulate(order, delays));
    }
  }
  EXPECT_GT(switches, 300);
  EXPECT_LT(switching, fixed);
}

TEST(Switching, OnlyRobotsBehindFailedOnesAreBlocked) {
  std::int64_t stuck_fixed = 0;
  std::int64_t stuck_switching = 0;
  for (std::uint64_t seed = 0; seed < 60; seed += 2) {
    const Instance instance = dense_instance(seed);
    const auto plan = plan_of(instance);
    if (!plan) continue;
    const ActionDependencyGraph order(instance, *plan);
    for (std::uint64_t schedule = 0; schedule < 10; ++schedule) {
      const Delays delays(order, schedule, true);
      const SwitchableTrace switched = simulate_switchable(instance.world(), *plan, order, delays);
      const std::vector<BlockedRobot> fixed = blocked_robots(order, simulate(order, delays));
      bool has_failed = switched.blocked_robots.empty();
      for (const BlockedRobot& s : switched.blocked_robots) {
        has_failed |= s.waits_for == s.agent;
        EXPECT_TRUE(std::ranges::find(switched.blocked_robots, s.waits_for, &BlockedRobot::agent) !=
                    switched.blocked_robots.end());
      }
      EXPECT_TRUE(has_failed) << seed << ", " << schedule;
      stuck_fixed += std::ssize(fixed);
      stuck_switching += std::ssize(switched.blocked_robots);
    }
  }
  EXPECT_GT(stuck_fixed, 200);
  EXPECT_LT(stuck_switching, stuck_fixed);
}

}  // namespace switching_test
}  // namespace grove::detail
