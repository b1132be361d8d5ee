// SPDX-License-Identifier: MIT
// Improves plans of tiny instances with choices, and compares them with the oracle.
#include "assignment/exchange_search.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "assignment/assignment.h"
#include "assignment/assignment_search.h"
#include "tests/assignment/solved_instances.h"

namespace grove::detail {
namespace assignment_test {

constexpr std::int64_t kEffort = 30'000;

// Returns the cheapest plan that the search finds from `plan`; each of its plans must be valid.
Plan improved(const Instance& instance, const Plan& plan, std::uint64_t seed = 1) {
  const DistanceFields distances(instance);
  AssignmentSearch assignments(instance, distances, seed);
  ExchangeSearch search(instance, distances, assignments.routes(), seed);
  search.start_from(plan);
  Plan best = plan;
  while (auto better = search.improve(best.cost, kEffort, Limits())) {
    EXPECT_EQ(verdict(instance, *better), "");
    EXPECT_LT(better->cost, best.cost);
    best = *std::move(better);
  }
  return best;
}

// Starts from the best plan of an assignment that is often not the best one.
TEST(ExchangeSearch, PlansAreValidAndOftenOptimal) {
  int worse = 0;
  int optimal = 0;
  for_each_instance(250, [&](const Instance& instance, const oracle::Answer& truth) {
    if (!truth.plan) return;
    const DistanceFields distances(instance);
    AssignmentSearch assignments(instance, distances, 1);
    auto assignment = assignments.first(Limits());
    if (!assignment) return;
    for (int more = 0; more < 5; ++more)
      if (auto other = assignments.next(kInfiniteCost, Limits())) assignment = std::move(other);
    const auto start = oracle::solve_jointly(with_assignment(instance, *assignment), kStates);
    if (!start.plan) return;
    const Plan plan = with_stated_visits(instance, *start.plan);
    const Plan better = improved(instance, plan);
    EXPECT_GE(better.cost, truth.plan->cost);
    if (plan.cost == truth.plan->cost) return;
    ++worse;
    optimal += better.cost == truth.plan->cost ? 1 : 0;
  });
  EXPECT_GT(worse, 20);
  EXPECT_GT(2 * optimal, worse) << worse;
}

TEST(ExchangeSearch, KeepsAnOptimalPlan) {
  int plans = 0;
  for_each_instance(200, [&](const Instance& instance, const oracle::Answer& truth) {
    if (!truth.plan) return;
    const DistanceFields distances(instance);
    AssignmentSearch assignments(instance, distances, 1);
    ExchangeSearch search(instance, distances, assignments.routes(), 1);
    search.start_from(*truth.plan);
    const auto same = search.improve(kInfiniteCost, kEffort, Limits());
    ASSERT_TRUE(same);
    EXPECT_EQ(verdict(instance, *same), "");
    EXPECT_EQ(same->cost, truth.plan->cost);
    ++plans;
  });
  EXPECT_GT(plans, 60);
}

// Two agents in a row, each with the task or the goal next to the other one.
Instance crossed(bool by_goals) {
  InstanceBuilder builder(Grid(9, 2, std::vector<bool>(18, true)));
  for (const auto& [id, start] : {std::pair("a", 0), std::pair("b", 8)}) {
    AgentSpec spec{.id = id, .start = {.place = start}, .goal = Place{start + 9}};
    if (by_goals) {
      spec.goal = std::nullopt;
      spec.goals = std::vector<Place>{9, 17};
    }
    builder.add_agent(std::move(spec));
  }
  for (const int x : {1, 7})
    if (!by_goals)
      builder.add_task("t" + std::to_string(x), Place{x}, std::vector<std::string>{"a", "b"}, 0, 1);
  return std::move(builder).build();
}

TEST(ExchangeSearch, ExchangesTasksAndGoals) {
  for (const bool by_goals : {false, true}) {
    const Instance instance = crossed(by_goals);
    Assignment assignment(2);
    if (by_goals) {
      assignment[0].goal = 17;
      assignment[1].goal = 9;
    } else {
      assignment[0].visits = {1};
      assignment[1].visits = {0};
    }
    const auto start = oracle::solve_jointly(with_assignment(instance, assignment));
    const Cost best = oracle::solve_jointly(instance).plan->cost;
    ASSERT_GT(start.plan->cost, best);
    const Plan plan = improved(instance, with_stated_visits(instance, *start.plan));
    EXPECT_EQ(plan.cost, best);
    EXPECT_NE(assignment_of(instance, plan), assignment);
  }
}

// The visit to `t` is stated during the execution of `long`, on the same place.
TEST(ExchangeSearch, KeepsTaskExecutions) {
  InstanceBuilder builder(Grid(3, 2, std::vector<bool>(6, true)));
  builder.add_agent("a", Place{0}, Place{2});
  builder.add_agent("b", Place{3}, Place{5});
  builder.add_task("long", Place{1}, std::vector<std::string>{"a"}, 2);
  builder.add_task("t", Place{1}, std::vector<std::string>{"a", "b"}, 0, 1);
  const Instance instance = std::move(builder).build();
  Plan plan;
  plan.cost = 6;
  plan.agents.resize(2);
  plan.agents[0] = {
      .cost = 4, .sequence = {1, 0}, .path = {0, 1, 1, 1, 2}, .work = {{0, 1, 3}, {1, 1, 1}}};
  plan.agents[1] = {.cost = 2, .sequence = {}, .path = {3, 4, 5}};
  ASSERT_EQ(verdict(instance, plan), "");
  EXPECT_EQ(improved(instance, plan).cost, 6);
  const DistanceFields distances(instance);
  AssignmentSearch assignments(instance, distances, 1);
  ExchangeSearch search(instance, distances, assignments.routes(), 1);
  search.start_from(plan);
  const auto same = search.improve(kInfiniteCost, kEffort, Limits());
  ASSERT_TRUE(same);
  EXPECT_EQ(same->cost, 6);
}

// The path of the turning agent, which need not move, is not complete before its turn ends.
TEST(ExchangeSearch, AgentCompletesItsTurn) {
  InstanceBuilder builder(Grid(4, 2, std::vector<bool>(8, true)));
  builder.add_agent(
      {.id = "turning",
       .start = {.place = 0, .heading = Heading::kNorth, .to = Heading::kWest, .steps = 1},
       .goal = {},
       .motion = {.turn_steps = 3}});
  builder.add_agent("other", Place{4}, Place{7});
  builder.add_task("t", Place{6}, std::vector<std::string>{"turning", "other"}, 0, 1);
  const Instance instance = std::move(builder).build();
  const oracle::Answer truth = oracle::solve_jointly(instance);
  const DistanceFields distances(instance);
  AssignmentSearch assignments(instance, distances, 1);
  ExchangeSearch search(instance, distances, assignments.routes(), 1);
  search.start_from(*truth.plan);
  EXPECT_FALSE(search.improve(truth.plan->cost, kEffort, Limits()));
  const auto same = search.improve(kInfiniteCost, kEffort, Limits());
  ASSERT_TRUE(same);
  EXPECT_EQ(verdict(instance, *same), "");
  EXPECT_EQ(same->cost, truth.plan->cost);
}

TEST(ExchangeSearch, IsRepeatable) {
  const Instance instance = crossed(false);
  Assignment assignment(2);
  assignment[0].visits = {0, 1};
  const auto start = oracle::solve_jointly(with_assignment(instance, assignment));
  const Plan plan = with_stated_visits(instance, *start.plan);
  const Plan one = improved(instance, plan, 3);
  const Plan other = improved(instance, plan, 3);
  for (const AgentIndex agent : {0, 1}) {
    EXPECT_EQ(one.agents[agent].path, other.agents[agent].path);
    EXPECT_EQ(one.agents[agent].sequence, other.agents[agent].sequence);
  }
}

TEST(ExchangeSearch, StopsAtALimit) {
  const Instance instance = crossed(false);
  const DistanceFields distances(instance);
  AssignmentSearch assignments(instance, distances, 1);
  ExchangeSearch search(instance, distances, assignments.routes(), 1);
  search.start_from(*oracle::solve_jointly(instance).plan);
  Limits limits;
  limits.stop(StopReason::kTime);
  EXPECT_FALSE(search.improve(kInfiniteCost, kEffort, limits));
}

}  // namespace assignment_test
}  // namespace grove::detail
