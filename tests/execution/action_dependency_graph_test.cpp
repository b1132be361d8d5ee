// SPDX-License-Identifier: MIT
#include "execution/action_dependency_graph.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <stdexcept>

#include "engine/solve.h"
#include "tests/fuzz/random_instance.h"
#include "tests/support/clocks.h"
#include "tests/support/instances.h"

namespace grove::detail {
namespace action_dependency_graph_test {

using testing::AgentSpec;
using ::testing::ElementsAre;
using testing::instance_of;

// Returns a plan from paths given as cells.
Plan plan_of(const Instance& instance, const std::vector<std::vector<Position>>& paths) {
  Plan plan;
  for (const auto& cells : paths) {
    AgentPlan agent;
    for (const Position cell : cells) agent.path.push_back(instance.grid().cell(cell));
    agent.cost = static_cast<Time>(cells.size()) - 1;
    plan.cost += agent.cost;
    plan.agents.push_back(agent);
  }
  return plan;
}

std::vector<ActionIndex> dependencies(const ActionDependencyGraph& order) {
  std::vector<ActionIndex> dependencies;
  for (ActionIndex a = 0; a < static_cast<ActionIndex>(order.actions().size()); ++a)
    dependencies.push_back(order.after(a));
  return dependencies;
}

TEST(ActionDependencyGraph, OmitsWaits) {
  const Instance instance = instance_of({"..."}, {AgentSpec{{0, 0}, Position{2, 0}}});
  const ActionDependencyGraph order(instance,
                                    plan_of(instance, {{{0, 0}, {0, 0}, {1, 0}, {1, 0}, {2, 0}}}));
  ASSERT_EQ(order.actions().size(), 2u);
  EXPECT_EQ(order.actions()[0].begin, 1);
  EXPECT_EQ(order.actions()[1].begin, 3);
  EXPECT_EQ(order.dependency_count(), 0);
}

TEST(ActionDependencyGraph, FollowerDependsOnTheMoveOfItsLeader) {
  const Instance instance =
      instance_of({"...."}, {AgentSpec{{1, 0}, Position{3, 0}}, AgentSpec{{0, 0}, Position{2, 0}}});
  const ActionDependencyGraph order(
      instance, plan_of(instance, {{{1, 0}, {2, 0}, {3, 0}}, {{0, 0}, {1, 0}, {2, 0}}}));
  EXPECT_THAT(dependencies(order), ElementsAre(kNoAction, kNoAction, 0, 1));
}

// Agent 1 enters places that agent 0 has left. The dependency for a place is omitted if agent 1 has
// already entered another place that agent 0 left later, because the dependency for
// that place implies it.
TEST(ActionDependencyGraph, OmitsTransitiveDependencies) {
  const Instance instance = instance_of(
      {"....", "...."}, {AgentSpec{{0, 0}, Position{3, 1}}, AgentSpec{{0, 1}, Position{3, 0}}});
  const ActionDependencyGraph order(
      instance,
      plan_of(instance,
              {{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {3, 1}},
               {{0, 1}, {0, 1}, {0, 1}, {0, 1}, {0, 1}, {1, 1}, {2, 1}, {2, 0}, {3, 0}}}));
  EXPECT_EQ(order.dependency_count(), 2);  // for (2, 0), and for (3, 0), which is left later
  const Instance back = instance_of(
      {"....", "...."}, {AgentSpec{{0, 0}, Position{3, 1}}, AgentSpec{{0, 1}, Position{0, 0}}});
  const ActionDependencyGraph backwards(
      back,
      plan_of(back,
              {{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {3, 1}},
               {{0, 1}, {0, 1}, {0, 1}, {0, 1}, {0, 1}, {1, 1}, {2, 1}, {2, 0}, {1, 0}, {0, 0}}}));
  EXPECT_EQ(backwards.dependency_count(),
            1);  // for (2, 0) only: (1, 0) and (0, 0) were left earlier
  EXPECT_EQ(backwards.removed_dependency_count(), 2);
}

TEST(ActionDependencyGraph, RotationIsOneStep) {
  const Instance instance = instance_of(
      {"..", ".."}, {AgentSpec{{0, 0}, Position{1, 0}}, AgentSpec{{1, 0}, Position{1, 1}},
                     AgentSpec{{1, 1}, Position{0, 1}}, AgentSpec{{0, 1}, Position{0, 0}}});
  const ActionDependencyGraph order(
      instance,
      plan_of(instance, {{{0, 0}, {1, 0}}, {{1, 0}, {1, 1}}, {{1, 1}, {0, 1}}, {{0, 1}, {0, 0}}}));
  EXPECT_EQ(order.rings(), 1);
  ASSERT_EQ(order.step_count(), 1);
  EXPECT_THAT(order.step(0), ::testing::UnorderedElementsAre(0, 1, 2, 3));
  EXPECT_EQ(order.dependency_count(), 0);
}

TEST(ActionDependencyGraph, RefusesCollisions) {
  const Instance instance =
      instance_of({"...."}, {AgentSpec{{0, 0}, Position{2, 0}}, AgentSpec{{3, 0}, Position{1, 0}}});
  EXPECT_THROW(ActionDependencyGraph(instance, plan_of(instance, {{{0, 0}, {1, 0}, {2, 0}},
                                                                  {{3, 0}, {2, 0}, {1, 0}}})),
               std::invalid_argument);  // a swap
  EXPECT_THROW(ActionDependencyGraph(
                   instance, plan_of(instance, {{{0, 0}, {1, 0}}, {{3, 0}, {2, 0}, {1, 0}}})),
               std::invalid_argument);  // at rest
  EXPECT_THROW(ActionDependencyGraph(instance, Plan{}), std::invalid_argument);
}

// --- random plans ---

// Returns all dependencies by definition, as pairs: `first` must be completed before `second`
// starts. For each place, a robot that enters it after another robot waits until that robot has
// left, except within one rotation. The actions of one agent depend on each other in order.
// close_transitively() adds the implied dependencies.
std::set<std::pair<ActionIndex, ActionIndex>> all_waits(const World& world,
                                                        const ActionDependencyGraph& order,
                                                        const std::vector<bool>& in_rotation) {
  const auto actions = order.actions();
  const auto count = static_cast<ActionIndex>(actions.size());
  std::set<std::pair<ActionIndex, ActionIndex>> dependency_count;
  for (ActionIndex a = 0; a < count; ++a) {
    for (ActionIndex b = 0; b < count; ++b) {
      if (actions[a].agent == actions[b].agent) {
        if (a < b) dependency_count.emplace(a, b);
      } else if (actions[a].kind == Action::Kind::kMove && actions[b].kind == Action::Kind::kMove &&
                 world.place(actions[a].from) == world.place(actions[b].to) &&
                 actions[a].begin <= actions[b].begin &&
                 !(in_rotation[a] && in_rotation[b] && actions[a].begin == actions[b].begin)) {
        dependency_count.emplace(a, b);
      }
    }
  }
  return dependency_count;
}

void close_transitively(std::set<std::pair<ActionIndex, ActionIndex>>& dependency_count,
                        const ActionDependencyGraph& order) {
  const auto count = static_cast<ActionIndex>(order.actions().size());
  std::vector<std::vector<bool>> is(count, std::vector<bool>(count));
  for (const auto& [a, b] : dependency_count) is[a][b] = true;
  // A dependency of one action of a rotation holds for all its actions, and an action that depends
  // on one action of a rotation depends on all of them.
  for (std::int32_t step = 0; step < order.step_count(); ++step)
    for (const ActionIndex b : order.step(step))
      for (const ActionIndex c : order.step(step))
        for (ActionIndex a = 0; a < count; ++a) {
          if (is[a][b]) is[a][c] = true;
          if (is[b][a] && b != c) is[c][a] = true;
        }
  for (ActionIndex k = 0; k < count; ++k)
    for (ActionIndex a = 0; a < count; ++a)
      if (is[a][k])
        for (ActionIndex b = 0; b < count; ++b)
          if (is[k][b]) is[a][b] = true;
  dependency_count.clear();
  for (ActionIndex a = 0; a < count; ++a)
    for (ActionIndex b = 0; b < count; ++b)
      if (is[a][b]) dependency_count.emplace(a, b);
}

std::set<std::pair<ActionIndex, ActionIndex>> waits_of(const ActionDependencyGraph& order,
                                                       ActionIndex without = kNoAction) {
  std::set<std::pair<ActionIndex, ActionIndex>> dependency_count;
  for (ActionIndex a = 0; a < static_cast<ActionIndex>(order.actions().size()); ++a) {
    if (order.before(a) != kNoAction) dependency_count.emplace(order.before(a), a);
    if (order.after(a) != kNoAction && a != without) dependency_count.emplace(order.after(a), a);
  }
  return dependency_count;
}

TEST(ActionDependencyGraph, EqualsTheDefinitionWithoutRedundancy) {
  int plans = 0;
  int rings = 0;
  std::int64_t left_out = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const Instance instance = fuzz::random_world(seed).build();
    SolveOptions options;
    options.omega = Omega::infinite();
    const testing::ClockReadingLimit limits(10'000);
    const Solution solution = solve(instance, options, limits);
    if (!solution.plan) continue;
    ++plans;
    const ActionDependencyGraph order(instance, *solution.plan);
    rings += static_cast<int>(order.rings());
    left_out += order.removed_dependency_count();
    std::vector<bool> in_rotation(order.actions().size());
    for (std::int32_t step = 0; step < order.step_count(); ++step)
      for (const ActionIndex a : order.step(step)) in_rotation[a] = order.step(step).size() > 1;
    auto expected = all_waits(instance.world(), order, in_rotation);
    close_transitively(expected, order);
    auto actual = waits_of(order);
    close_transitively(actual, order);
    EXPECT_EQ(actual, expected) << seed;
    for (ActionIndex a = 0; a < static_cast<ActionIndex>(order.actions().size()); ++a) {
      EXPECT_FALSE(expected.contains({a, a})) << seed;  // no cyclic dependency
      if (order.after(a) == kNoAction) continue;
      auto less = waits_of(order, a);
      close_transitively(less, order);
      EXPECT_NE(less, expected) << seed << ": " << a << " need not wait";
    }
  }
  EXPECT_GT(plans, 150);
  EXPECT_GT(rings, 0);
  EXPECT_GT(left_out, 50);
}

}  // namespace action_dependency_graph_test
}  // namespace grove::detail
