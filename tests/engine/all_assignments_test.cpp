// SPDX-License-Identifier: MIT
// Compares the search over all assignments with the oracle, on tiny instances with choices.
#include "engine/all_assignments.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "assignment/assignment_search.h"
#include "assignment/route_bound.h"
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
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(testing::fuzz_rounds(400));
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
  EXPECT_GT(instances, 100);
  EXPECT_GT(2 * solved, instances);
}

}  // namespace all_assignments_test
}  // namespace grove::detail
