// SPDX-License-Identifier: MIT
// Compares decisions on choices, and branch and bound over them, with the oracle.
#include "assignment/assignment_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "assignment/assignment.h"
#include "assignment/assignment_search.h"
#include "assignment/choice_neighborhoods.h"
#include "assignment/route_bound.h"
#include "model/random.h"
#include "tests/assignment/solved_instances.h"

namespace grove::detail {
namespace assignment_test {

// Calls test(instance, truth, its routes) for instances with a plan.
template <class Test>
void for_each_solved(int rounds, Test test) {
  for_each_instance(rounds, [&](const Instance& instance, const oracle::Answer& truth) {
    if (!truth.plan) return;
    const DistanceFields distances(instance);
    AssignmentSearch search(instance, distances, 1);
    if (search.first(Limits())) test(instance, truth, search.routes());
  });
}

bool contains(const std::vector<TaskIndex>& tasks, TaskIndex task) {
  return std::ranges::binary_search(tasks, task);
}

// True if the plan makes only choices that are left, where surplus visits do not count.
bool permits(const Instance& instance, const std::vector<RouteChoices>& choices, const Plan& plan) {
  const Assignment made = assignment_of(instance, plan);
  for (TaskIndex task = 0; task < instance.task_count(); ++task) {
    if (instance.task(task).needs_all()) continue;
    int counted = 0;
    for (AgentIndex agent = 0; agent < instance.agent_count(); ++agent) {
      const bool visits = contains(made[agent].visits, task);
      if (!visits && contains(choices[agent].required, task)) return false;
      counted += visits && contains(choices[agent].visits, task) ? 1 : 0;
    }
    if (counted < instance.task(task).need) return false;
  }
  for (AgentIndex agent = 0; agent < instance.agent_count(); ++agent)
    if (made[agent].goal && std::ranges::count(choices[agent].goals, *made[agent].goal) == 0)
      return false;
  return true;
}

// Removes or requires a random choice, so that the plan is still permitted.
std::vector<RouteChoices> with_decision(const Instance& instance, std::vector<RouteChoices> choices,
                                        const Plan& plan, Random& random) {
  RouteChoices& own = choices[random.below(instance.agent_count())];
  const std::vector<RouteChoices> before = choices;
  if (!own.goals.empty() && random.below(3) == 0) {
    own.goals.erase(own.goals.begin() + random.below(static_cast<int>(own.goals.size())));
  } else if (!own.visits.empty()) {
    const TaskIndex task = own.visits[random.below(static_cast<int>(own.visits.size()))];
    if (random.below(2) == 0)
      std::erase(own.visits, task);
    else if (!contains(own.required, task))
      own.required.insert(std::ranges::upper_bound(own.required, task), task);
  }
  const bool is_kept =
      permits(instance, choices, plan) && std::ranges::includes(own.visits, own.required);
  return is_kept ? choices : before;
}

TEST(AssignmentTree, FixedAndDecidedChoicesKeepTheBound) {
  int tight = 0;
  int instances = 0;
  for_each_solved(
      400, [&](const Instance& instance, const oracle::Answer& truth, const Routes& routes) {
        const Cost cost = truth.plan->cost;
        Random random(instances);
        RouteBound bound(routes);
        bound.improve(10'000, Limits());
        for (int decision = 0; decision < 6; ++decision) {
          if (!bound.fix(cost + 1 + 3 / (decision + 1), Limits())) break;
          ASSERT_TRUE(bound.is_feasible());
          ASSERT_TRUE(permits(instance, bound.choices(), *truth.plan));
          bound.restrict_to(with_decision(instance, bound.choices(), *truth.plan, random));
          ASSERT_TRUE(bound.is_feasible());
          ASSERT_TRUE(permits(instance, bound.choices(), *truth.plan));
          bound.improve(decision % 2 == 0 ? 10'000 : 300, Limits());
          ASSERT_LE(bound.lower_bound(), cost);
        }
        ++instances;
        tight += bound.lower_bound() == cost ? 1 : 0;
      });
  EXPECT_GT(instances, 100);
  EXPECT_GT(3 * tight, instances);
}

constexpr std::size_t kTreeBytes = std::size_t{1} << 28;

// The least cost of plans with an assignment.
Cost cost_of(const Instance& instance, const Assignment& assignment) {
  const auto truth = oracle::solve_jointly(with_assignment(instance, assignment), kStates);
  return truth.plan ? truth.plan->cost : kInfiniteCost;
}

TEST(AssignmentTree, BoundsAreTrue) {
  int proven = 0;
  int trees = 0;
  std::int64_t nodes = 0;
  int leaves = 0;
  for_each_solved(250, [&](const Instance& instance, const oracle::Answer& truth,
                           const Routes& routes) {
    const Cost cost = truth.plan->cost;
    const bool has_goals = std::ranges::all_of(instance.agents(), &Agent::has_destination);
    for (const Cost cutoff : {cost, cost + 1, cost + 4}) {
      RouteBound bound(routes);
      bound.improve(1000, Limits());
      AssignmentTree tree(instance, bound, kTreeBytes);
      Random random(++trees);
      auto outcome = AssignmentTree::Outcome::kOpen;
      for (int turn = 0; turn < 2000; ++turn) {
        outcome = tree.run(cutoff, 1000, random.below(2) == 0, Limits());
        ASSERT_LE(tree.lower_bound(), cost);
        if (outcome != AssignmentTree::Outcome::kOpen && outcome != AssignmentTree::Outcome::kNode)
          break;
        if (outcome != AssignmentTree::Outcome::kNode) continue;
        const auto leaf = tree.leaf();
        const Cost found = leaf && has_goals ? cost_of(instance, *leaf) : 0;
        if (leaf) {
          EXPECT_TRUE(is_complete(instance, *leaf));
          ++leaves;
        }
        tree.resolve(found);
        ASSERT_LE(tree.lower_bound(), cost);
      }
      nodes += tree.nodes();
      proven += tree.lower_bound() == cost ? 1 : 0;
      ASSERT_TRUE(outcome != AssignmentTree::Outcome::kClosed || cutoff == cost);
    }
  });
  EXPECT_GT(trees, 200);
  EXPECT_GT(2 * proven, trees);
  EXPECT_GT(nodes, trees);
  EXPECT_GT(leaves, 50);
}

InstanceBuilder row() {
  return InstanceBuilder(Grid(8, 1, std::vector<bool>(8, true)));
}

// After fixing, no choice is left of the goal of an agent without a choice.
TEST(AssignmentTree, GoalOfAnAgentWithoutAChoice) {
  InstanceBuilder builder = row();
  builder.add_agent({.id = "a",
                     .start = {.place = Place{1}},
                     .goal = {},
                     .goals = std::vector<Place>{Place{0}, Place{6}}});
  builder.add_agent("b", Place{5}, Place{6});
  builder.add_task("t", Place{4}, std::vector<std::string>{"a", "b"}, 0, 1);
  const Instance instance = std::move(builder).build();
  const DistanceFields distances(instance);
  AssignmentSearch search(instance, distances, 1);
  ASSERT_TRUE(search.first(Limits()));
  RouteBound bound(search.routes());
  bound.improve(10'000, Limits());
  ASSERT_TRUE(bound.fix(1000, Limits()));
  EXPECT_EQ(bound.choices()[0].goals, std::vector<Place>{Place{0}});
}

// Agent a begins t at the start, so b can rest on t although t needs no further visit.
TEST(AssignmentTree, RestOnATaskThatAnotherAgentExecutes) {
  for (const bool has_goal : {false, true}) {
    InstanceBuilder builder = row();
    builder.add_agent(
        {.id = "a", .start = {.place = Place{4}}, .goal = Place{3}, .working = WorkBegun{"t", 1}});
    builder.add_agent("b", Place{6}, has_goal ? std::optional(Place{7}) : std::nullopt);
    builder.add_task("of b", Place{5}, std::vector<std::string>{"b"});
    builder.add_task("t", Place{4}, std::vector<std::string>{"a", "b"}, 2, 1);
    const Instance instance = std::move(builder).build();
    const DistanceFields distances(instance);
    AssignmentSearch search(instance, distances, 1);
    ASSERT_TRUE(search.first(Limits()));
    RouteBound bound(search.routes());
    bound.improve(10'000, Limits());
    AssignmentTree tree(instance, bound, kTreeBytes);
    EXPECT_EQ(tree.run(1000, 10'000, true, Limits()) == AssignmentTree::Outcome::kStuck, !has_goal);
  }
}

// From a plan that is not optimal, the neighbourhoods include the optimal plan.
TEST(ChoiceNeighborhoods, TheLastOneIsTheWholeInstance) {
  int plans = 0;
  for_each_solved(
      300, [&](const Instance& instance, const oracle::Answer& truth, const Routes& routes) {
        const DistanceFields distances(instance);
        AssignmentSearch assignments(instance, distances, 2);
        auto assignment = assignments.first(Limits());
        for (int more = 0; more < 3 && assignment; ++more)
          if (auto other = assignments.next(kInfiniteCost, Limits())) assignment = std::move(other);
        const auto start = oracle::solve_jointly(with_assignment(instance, *assignment), kStates);
        if (!start.plan || start.plan->cost <= truth.plan->cost) return;
        RouteBound bound(routes);
        bound.improve(1000, Limits());
        ChoiceNeighborhoods neighborhoods(instance, routes, bound, 1);
        neighborhoods.start_from(with_stated_visits(instance, *start.plan), Limits());
        bool includes = false;
        while (!neighborhoods.is_over())
          if (RouteBound* const choices = neighborhoods.next(Limits())) {
            EXPECT_TRUE(choices->is_feasible());
            includes |= permits(instance, choices->choices(), *truth.plan);
          }
        if (!bound.fix(start.plan->cost, Limits())) return;  // then there are none
        EXPECT_TRUE(bound.is_feasible());
        EXPECT_TRUE(includes);
        ++plans;
      });
  EXPECT_GT(plans, 20);
}

}  // namespace assignment_test
}  // namespace grove::detail
