// SPDX-License-Identifier: MIT
// Compares assignments and bounds with the oracle, on tiny instances of all kinds with choices.
#include "assignment/assignment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "assignment/assignment_search.h"
#include "assignment/choice_bounds.h"
#include "assignment/implied_tasks.h"
#include "assignment/infeasible_choices.h"
#include "assignment/route_bound.h"
#include "model/check.h"
#include "tests/assignment/solved_instances.h"
#include "tests/oracle/joint_oracle.h"
#include "tests/support/instances.h"

namespace grove::detail {
namespace assignment_test {

TEST(Assignment, OraclePlansAreValid) {
  int plans = 0;
  for_each_instance(300, [&](const Instance& instance, const oracle::Answer& truth) {
    if (!truth.plan) return;
    EXPECT_EQ(verdict(instance, *truth.plan), "");
    ++plans;
  });
  EXPECT_GT(plans, 100);
}

TEST(ImpliedTasks, WithoutThemTheLeastCostIsTheSame) {
  int plans = 0;
  for_each_instance(2000, [&](const Instance& instance, const oracle::Answer& truth) {
    const auto reduced = WithoutImpliedTasks::make(instance);
    if (!reduced) return;
    const oracle::Answer other = oracle::solve_jointly(reduced->instance(), kStates);
    EXPECT_EQ(other.plan.has_value(), truth.plan.has_value());
    if (!other.plan || !truth.plan) return;
    const Plan whole = reduced->to_whole(*other.plan);
    EXPECT_EQ(verdict(instance, whole), "");
    EXPECT_EQ(whole.cost, truth.plan->cost);
    ++plans;
  });
  EXPECT_GT(plans, 30);
}

// Agent `a`, which must visit `far`, could rest on the place of `t`.
TEST(ImpliedTasks, AnAgentKeepsItsPlacesOfRest) {
  const auto implied = [](std::optional<Place> goal) {
    InstanceBuilder builder(Grid(5, 2, std::vector<bool>(10, true)));
    builder.add_agent("a", Place{0}, goal);
    builder.add_agent("b", Place{5}, Place{9});
    builder.add_task("far", Place{4}, std::vector<std::string>{"a"});
    builder.add_task("u", Place{2}, std::vector<std::string>{"b"});
    builder.add_task("t", Place{2}, std::vector<std::string>{"a", "b"}, 0, 1);
    const Instance instance = std::move(builder).build();
    return WithoutImpliedTasks::make(instance).has_value();
  };
  EXPECT_TRUE(implied(Place{3}));
  EXPECT_FALSE(implied(std::nullopt));
}

// Plans of the instance with an assignment are plans of the instance, and are not cheaper.
TEST(Assignment, PlansWithAnAssignmentAreValid) {
  int plans = 0;
  int optimal = 0;
  for_each_instance(300, [&](const Instance& instance, const oracle::Answer& truth) {
    const DistanceFields distances(instance);
    AssignmentSearch search(instance, distances, 1);
    auto assignment = search.first(Limits());
    if (!assignment) return;
    ASSERT_TRUE(is_complete(instance, *assignment));
    for (int more = 0; more < 3; ++more) {
      const auto other = search.next(kInfiniteCost, Limits());
      if (!other) break;
      ASSERT_TRUE(is_complete(instance, *other));
      EXPECT_NE(*other, *assignment);
      assignment = other;
    }
    const Instance fixed = with_assignment(instance, *assignment);
    EXPECT_FALSE(fixed.has_choices());
    const oracle::Answer answer = oracle::solve_jointly(fixed, kStates);
    if (!answer.plan) return;
    const Plan plan = with_stated_visits(instance, *answer.plan);
    EXPECT_EQ(verdict(instance, plan), "");
    ASSERT_TRUE(truth.plan);
    EXPECT_GE(plan.cost, truth.plan->cost);
    optimal += plan.cost == truth.plan->cost ? 1 : 0;
    ++plans;
  });
  EXPECT_GT(plans, 100);
  EXPECT_GT(4 * optimal, plans);
}

// Plans with the choices of a plan fixed.
TEST(FixChoices, PlanStaysValidWithTheSameCost) {
  int plans = 0;
  int with_new_goal = 0;
  for_each_instance(300, [&](const Instance& instance, const oracle::Answer& truth) {
    if (!truth.plan) return;
    const FixedChoices fixed = fix_choices(instance, *truth.plan);
    EXPECT_FALSE(fixed.instance.has_choices());
    EXPECT_EQ(verdict(fixed.instance, fixed.plan), "");
    EXPECT_EQ(fixed.plan.cost, truth.plan->cost);
    EXPECT_EQ(fixed.instance.task_count(), instance.task_count());
    const Assignment assignment = assignment_of(instance, *truth.plan);
    EXPECT_TRUE(is_complete(instance, assignment));
    for (AgentIndex i = 0; i < instance.agent_count(); ++i) {
      EXPECT_EQ(fixed.plan.agents[i].path, truth.plan->agents[i].path);
      EXPECT_EQ(fixed.instance.agent(i).tasks.size(),
                instance.agent(i).tasks.size() + assignment[i].visits.size());
      with_new_goal += fixed.instance.agent(i).goal && !instance.agent(i).has_destination() ? 1 : 0;
    }
    const Plan again = with_stated_visits(instance, fixed.plan);
    EXPECT_EQ(verdict(instance, again), "");
    ++plans;
  });
  EXPECT_GT(plans, 100);
  EXPECT_GT(with_new_goal, 0);
}

// "a" visits t and moves on, "b" visits t as well, "c" stays, and "d" ends on its own task.
TEST(FixChoices, EachAgentHasTheTasksThatItVisits) {
  InstanceBuilder builder(testing::grid_of({".....", "....."}));
  const std::vector<std::string> ids{"a", "b", "c", "d"};
  for (const Place start : {0, 4, 5, 9}) {
    const std::string& id = ids[static_cast<std::size_t>(builder.agent_ids().size())];
    builder.add_agent(id, start, std::nullopt);
  }
  builder.add_task("t", Place{1}, ids, 0, 1);
  builder.add_task("long", Place{8}, ids, 2, 1);
  const Instance instance = std::move(builder).build();
  const Plan plan{9,
                  {{3, {0}, {0, 1, 6, 7}, {{0, 1, 1}}},
                   {3, {0}, {4, 3, 2, 1}, {{0, 3, 3}}},
                   {0, {}, {5}, {}},
                   {3, {1}, {9, 8, 8, 8}, {{1, 1, 3}}}}};
  ASSERT_EQ(verdict(instance, plan), "");
  const FixedChoices fixed = fix_choices(instance, plan);
  EXPECT_EQ(verdict(fixed.instance, fixed.plan), "");
  EXPECT_EQ(fixed.plan.cost, 9);
  EXPECT_EQ(fixed.instance.task(0).agents, (std::vector<AgentIndex>{0, 1}));
  EXPECT_EQ(fixed.instance.task(1).agents, (std::vector<AgentIndex>{3}));
  EXPECT_EQ(fixed.instance.agent(0).goal, Place{7});  // it rests on no task that it visits
  for (const AgentIndex agent : {1, 2, 3})
    EXPECT_EQ(fixed.instance.agent(agent).goal, std::nullopt) << agent;
  EXPECT_TRUE(fixed.instance.agent(2).is_idle());
}

// A visit that the plan states after the agent has come to rest.
TEST(FixChoices, VisitAfterTheRestIsNotPaid) {
  InstanceBuilder builder(testing::grid_of({"..."}));
  builder.add_agent("a", Place{0}, std::nullopt);
  builder.add_agent("b", Place{2}, std::nullopt);
  builder.add_task("t", Place{1}, std::vector<std::string>{"a", "b"}, 0, 1);
  const Instance instance = std::move(builder).build();
  const Plan plan{3, {{3, {0}, {0, 1, 1, 1}, {{0, 3, 3}}}, {0, {}, {2}, {}}}};
  ASSERT_EQ(verdict(instance, plan), "");
  const FixedChoices fixed = fix_choices(instance, plan);
  EXPECT_EQ(verdict(fixed.instance, fixed.plan), "");
  EXPECT_EQ(fixed.plan.cost, 1);
}

// The search from a plan keeps its assignment, and improvement never raises the cost of the routes.
TEST(AssignmentSearch, FirstFromAPlanIsTheAssignmentOfThePlan) {
  int plans = 0;
  for_each_instance(300, [&](const Instance& instance, const oracle::Answer& truth) {
    if (!truth.plan) return;
    const DistanceFields distances(instance);
    for (const Cost weight : {0, 7}) {
      AssignmentSearch search(instance, distances, 1, weight);
      const auto first = search.first_from(*truth.plan, Limits());
      ASSERT_TRUE(first);
      EXPECT_TRUE(is_complete(instance, *first));
      const Cost cost = search.routes().cost();
      EXPECT_TRUE(is_complete(instance, search.improved(1000, Limits())));
      EXPECT_LE(search.routes().cost(), cost);
      plans += *first == assignment_of(instance, *truth.plan) ? 1 : 0;
    }
  });
  EXPECT_GT(plans, 150);
}

TEST(Assignment, BoundsAreTrue) {
  int tight = 0;
  int instances = 0;
  for_each_instance(600, [&](const Instance& instance, const oracle::Answer& truth) {
    const DistanceFields distances(instance);
    if (!truth.plan) return;
    EXPECT_EQ(infeasible_choices(instance, distances), std::nullopt);
    const Cost bound = lower_bound_of_choices(instance, distances, Limits());
    EXPECT_LE(bound, truth.plan->cost);
    tight += bound == truth.plan->cost ? 1 : 0;
    ++instances;
  });
  EXPECT_GT(4 * tight, instances);
}

// Expects that `choices` contain all choices of the plan.
void expect_contains(const Instance& instance, const std::vector<RouteBound::Choices>& choices,
                     const Plan& plan) {
  for (AgentIndex i = 0; i < instance.agent_count(); ++i) {
    const AgentPlan& agent = plan.agents[i];
    for (const WorkTime& work : agent.work)
      if (!instance.task(work.task).needs_all()) {
        EXPECT_EQ(std::ranges::count(choices[i].visits, work.task), 1);
      }
    if (!instance.agent(i).goals.empty()) {
      EXPECT_EQ(std::ranges::count(choices[i].goals, instance.world().place(agent.path.back())), 1);
    }
  }
}

// The Lagrangian bound holds after any number of steps, and fixes no choice of an optimal plan.
TEST(Assignment, RouteBoundsAreValid) {
  int instances = 0;
  int tight = 0;
  std::ptrdiff_t possible = 0;
  std::ptrdiff_t left = 0;
  for_each_instance(300, [&](const Instance& instance, const oracle::Answer& truth) {
    if (!truth.plan) return;
    const DistanceFields distances(instance);
    AssignmentSearch search(instance, distances, 1);
    if (!search.first(Limits())) return;
    RouteBound bound(search.routes());
    for (const std::int64_t effort : {1, 1'000, 100'000}) {
      const Cost before = bound.lower_bound();
      bound.improve(effort, Limits());
      EXPECT_GE(bound.lower_bound(), before);
      EXPECT_LE(bound.lower_bound(), truth.plan->cost);
      if (const auto choices = bound.choices_below(truth.plan->cost + 1, Limits()))
        expect_contains(instance, *choices, *truth.plan);
    }
    for (AgentIndex i = 0; i < instance.agent_count(); ++i)
      possible += std::ssize(instance.agent(i).options);
    if (const auto choices = bound.choices_below(truth.plan->cost, Limits()))
      for (const RouteBound::Choices& agent : *choices) left += std::ssize(agent.visits);
    tight += bound.lower_bound() == truth.plan->cost ? 1 : 0;
    ++instances;
  });
  EXPECT_GT(5 * tight, 2 * instances);
  EXPECT_LT(left, possible);
}

TEST(Assignment, TooFewGoals) {
  InstanceBuilder builder(Grid(4, 1, std::vector<bool>(4, true)));
  const auto add = [&](const std::string& id, Place start, std::vector<Place> goals) {
    builder.add_agent({.id = id, .start = {.place = start}, .goal = {}, .goals = std::move(goals)});
  };
  add("a", 0, {1, 2});
  add("b", 1, {1, 2});
  add("c", 2, {0, 3});
  add("d", 3, {2, 1});
  const Instance instance = std::move(builder).build();
  EXPECT_EQ(
      infeasible_choices(instance, DistanceFields(instance)),
      "agents 'a', 'b', 'd' have only 2 goals ([1, 0], [2, 0]), but each must end on one of its "
      "own");
}

TEST(Assignment, TaskThatTooFewAgentsReach) {
  InstanceBuilder builder(Grid(4, 1, {true, true, false, true}));
  builder.add_agent("a", Place{0}, Place{1});
  builder.add_agent("b", Place{3}, std::nullopt);
  builder.add_agent("c", Place{1}, std::nullopt);
  builder.add_task("t", Place{0}, std::vector<std::string>{"a", "b"}, 0, 1);
  builder.add_task("u", Place{3}, std::vector<std::string>{"a", "b", "c"}, 0, 2);
  const Instance instance = std::move(builder).build();
  EXPECT_EQ(
      infeasible_choices(instance, DistanceFields(instance)),
      "task 'u' needs 2 of its agents 'a', 'b', 'c', but only 'b' can visit it: walls separate "
      "[3, 0] from the starts of 'a', 'c'");
}

TEST(Assignment, TaskBehindWalls) {
  InstanceBuilder builder(Grid(4, 1, {true, true, false, true}));
  builder.add_agent("a", Place{0}, std::nullopt);
  builder.add_agent("b", Place{1}, std::nullopt);
  builder.add_task("t", Place{3}, std::vector<std::string>{"a", "b"}, 0, 1);
  const Instance instance = std::move(builder).build();
  EXPECT_EQ(
      infeasible_choices(instance, DistanceFields(instance)),
      "task 't' needs 1 of its agents 'a', 'b', but none of them can visit it: walls separate "
      "[3, 0] from the starts of all of them");
}

// One-way roads lead from A and B to T, and from C to A. Agent a starts at A, and agent b at B,
// where it must end.
Instance one_way_instance(Place task, const std::vector<std::string>& agents) {
  InstanceBuilder builder(Roadmap({{"A", {0, 0}}, {"B", {1, 0}}, {"T", {2, 0}}, {"C", {3, 0}}},
                                  {{0, 2, 1, true}, {1, 2, 1, true}, {3, 0, 1, true}}));
  builder.add_agent("a", Place{0}, std::nullopt);
  builder.add_agent("b", Place{1}, Place{1});
  builder.add_task("t", task, agents);
  builder.add_task("u", Place{2}, std::vector<std::string>{"a", "b"}, 0, 1);
  return std::move(builder).build();
}

TEST(Assignment, TaskOnOneWayRoads) {
  const Instance unreachable = one_way_instance(Place{3}, {"a"});
  EXPECT_EQ(
      infeasible_choices(unreachable, DistanceFields(unreachable)),
      R"(task 't' needs agent 'a', which cannot visit it: no roads lead from the start of 'a' to )"
      R"(["C"])");
  const Instance no_way_back = one_way_instance(Place{2}, {"a", "b"});
  EXPECT_EQ(infeasible_choices(no_way_back, DistanceFields(no_way_back)),
            R"(task 't' needs 2 of its agents 'a', 'b', but only 'a' can visit it: no path leads )"
            R"(from ["T"] to a destination of 'b')");
}

TEST(Assignment, TooFewReachableGoals) {
  InstanceBuilder builder(Grid(5, 1, {true, true, true, false, true}));
  const auto add = [&](const std::string& id, Place start, std::vector<Place> goals) {
    builder.add_agent({.id = id, .start = {.place = start}, .goal = {}, .goals = std::move(goals)});
  };
  add("a", 0, {1, 4});
  add("b", 2, {4, 1});
  const Instance instance = std::move(builder).build();
  EXPECT_EQ(infeasible_choices(instance, DistanceFields(instance)),
            "agents 'a', 'b' can reach only 1 goal ([1, 0]), but each must end on one of its own");
  InstanceBuilder other(Grid(3, 1, {true, false, true}));
  other.add_agent({.id = "a", .start = {.place = 0}, .goal = {}, .goals = {2}});
  const Instance cut_off = std::move(other).build();
  EXPECT_EQ(infeasible_choices(cut_off, DistanceFields(cut_off)),
            "agent 'a' can reach none of its goals");
}

}  // namespace assignment_test
}  // namespace grove::detail
