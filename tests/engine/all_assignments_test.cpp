// SPDX-License-Identifier: MIT
// Compares the search over all assignments with the oracle, on tiny instances with choices.
#include "engine/all_assignments.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "assignment/assignment_search.h"
#include "assignment/route_bound.h"
#include "model/random.h"
#include "tests/fuzz/random_instance.h"
#include "tests/oracle/joint_oracle.h"
#include "tests/support/fuzz_factor.h"
#include "tests/support/random_choices.h"

namespace grove::detail {
namespace all_assignments_test {

constexpr std::size_t kStates = 100'000;
constexpr std::int64_t kEffort = 300'000;

struct Found {
  bool is_over = false;
  Cost lower_bound = 0;
  std::optional<Cost> cost;
};

// Searches with multipliers that subgradient steps of this effort have found. Returns nullopt if
// the instance cannot be priced.
std::optional<Found> search(const Instance& instance, Cost cutoff, std::int64_t bound_effort) {
  const DistanceFields distances(instance);
  AssignmentSearch assignments(instance, distances, 1);
  if (!assignments.first(Limits())) return std::nullopt;
  RouteBound routes(assignments.routes());
  routes.improve(bound_effort, Limits());
  const Limits limits;
  const SolveOptions options;
  const auto priced = AllAssignmentsSearch::make(instance, routes, cutoff, options, limits);
  if (!priced) return std::nullopt;
  Found found;
  found.is_over = !priced->run(cutoff, kEffort);
  found.lower_bound = priced->lower_bound();
  if (priced->plan()) found.cost = priced->plan()->cost;
  return found;
}

TEST(AllAssignments, AgreesWithTheOracle) {
  int solved = 0;
  int instances = 0;
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(testing::fuzz_rounds(150));
       ++seed) {
    SCOPED_TRACE(seed);
    const Instance instance = with_random_choices(fuzz::any_instance(seed).build(), seed);
    if (!instance.has_choices()) continue;
    const oracle::Answer truth = oracle::solve_jointly(instance, kStates);
    if (!truth.plan) continue;
    const Cost cost = truth.plan->cost;
    for (const Cost cutoff : {cost, cost + 1, cost + 5})
      for (const std::int64_t effort : {100, 100'000}) {
        const std::optional<Found> found = search(instance, cutoff, effort);
        if (!found) continue;
        ++instances;
        EXPECT_LE(found->lower_bound, cost);
        if (found->cost) {
          EXPECT_EQ(*found->cost, cost);
          EXPECT_EQ(found->lower_bound, cost);
        }
        solved += found->is_over ? 1 : 0;
        if (found->is_over && cutoff == cost) {
          EXPECT_EQ(found->lower_bound, cost);
        }
      }
  }
  EXPECT_GT(instances, 50);
  EXPECT_GT(2 * solved, instances);
}

// With many tasks nearby, whole multipliers next to the best ones often have no bound.
TEST(AllAssignments, ManyNearTasksHaveABound) {
  constexpr int kWidth = 6;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    std::vector<Place> places(kWidth * kWidth);
    std::iota(places.begin(), places.end(), 0);
    random.shuffle(places);
    InstanceBuilder builder(Grid(kWidth, kWidth, std::vector<bool>(places.size(), true)));
    std::vector<std::string> agents;
    for (int i = 0; i < 3; ++i) {
      agents.push_back("a" + std::to_string(i));
      builder.add_agent(agents.back(), places[i], places[3 + i]);
    }
    for (int i = 6; i < 24; ++i)
      builder.add_task("t" + std::to_string(i), places[i], agents, 0, 1 + random.below(2));
    const Instance instance = std::move(builder).build();
    const auto found = search(instance, kInfiniteCost, 3'000'000);
    ASSERT_TRUE(found);
    EXPECT_GT(found->lower_bound, 0);
  }
}

// An agent that does not pay for a goal rests on it.
TEST(AllAssignments, IdleAgentOnAGoalWithAPrice) {
  constexpr int kWidth = 6;
  const auto place = [](int x, int y) { return Place{y * kWidth + x}; };
  InstanceBuilder builder(Grid(kWidth, 3, std::vector<bool>(3 * kWidth, true)));
  builder.add_agent("idle", place(2, 1), std::nullopt);
  for (const int x : {1, 3})
    builder.add_agent({.id = "a" + std::to_string(x),
                       .start = {.place = place(x, 1)},
                       .goal = {},
                       .goals = std::vector<Place>{place(2, 1), place(0, 0), place(5, 0)}});
  const Instance instance = std::move(builder).build();
  const oracle::Answer truth = oracle::solve_jointly(instance);
  for (const Cost more : {1, 2, 5}) {
    const auto found = search(instance, truth.plan->cost + more, 100'000);
    ASSERT_TRUE(found);
    EXPECT_TRUE(found->is_over);
    EXPECT_EQ(found->cost, truth.plan->cost);
    EXPECT_EQ(found->lower_bound, truth.plan->cost);
  }
}

// Routes do not contain the turn that the agent completes before it rests.
TEST(AllAssignments, RoutesWithoutCost) {
  InstanceBuilder builder(Grid(3, 1, std::vector<bool>(3, true)));
  builder.add_agent(
      {.id = "turning",
       .start = {.place = 0, .heading = Heading::kNorth, .to = Heading::kWest, .steps = 2},
       .goal = {},
       .motion = {.turn_steps = 3}});
  builder.add_agent("other", Place{2}, std::nullopt);
  builder.add_task("t", Place{2}, std::vector<std::string>{"turning", "other"}, 0, 1);
  const Instance instance = std::move(builder).build();
  const auto found = search(instance, 1, 100'000);
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->is_over);
  EXPECT_EQ(found->lower_bound, 1);
}

}  // namespace all_assignments_test
}  // namespace grove::detail
