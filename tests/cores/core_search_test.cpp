// SPDX-License-Identifier: MIT
#include "cores/core_search.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <utility>
#include <vector>

#include "model/check.h"
#include "model/omega.h"
#include "tests/fuzz/random_instance.h"
#include "tests/oracle/joint_oracle.h"
#include "tests/support/fuzz_factor.h"

namespace grove::detail {
namespace core_search_test {

constexpr int kToTheEnd = 1'000'000;  // steps
constexpr std::size_t kMaxBytes = std::size_t{1} << 28;
using Outcome = CoreSearch::Outcome;

// A core-guided search with everything that it needs.
class Search {
 public:
  Search(const Instance& instance, Techniques techniques, std::uint64_t seed = 0)
      : problem_(instance, limits_),
        stops_(instance, problem_.distances),
        search_(problem_, stops_, techniques, kMaxBytes, limits_, nullptr, seed) {}

  // Runs for at most `steps` steps. `check` is called after each.
  template <class Check>
  Outcome run(Cost cutoff, int steps, Check check) {
    Outcome outcome = Outcome::kWorking;
    while (outcome == Outcome::kWorking && steps-- > 0) {
      outcome = search_.step(cutoff);
      check(search_);
    }
    return outcome;
  }
  Outcome run(Cost cutoff, int steps) {
    return run(cutoff, steps, [](const CoreSearch&) {});
  }
  CoreSearch& operator*() { return search_; }
  const CoreSearch* operator->() const { return &search_; }

 private:
  const Limits limits_;
  const Problem problem_;
  const AgentStopsCache stops_;
  CoreSearch search_;
};

Cost least_cost(const Instance& instance, AgentIndex agent) {
  const Limits limits;
  const DistanceFields distances(instance, limits);
  AgentStops stops(instance, distances, agent);
  SequenceStages goals(stops, SequenceClass{});
  Path path;
  FreeOrderSipp(instance.world()).find(goals, PathQuery{}, limits, path);
  return static_cast<Cost>(path.size()) - 1;
}

// An instance of any kind that has a plan, and an optimal plan.
struct SolvableCase {
  std::uint64_t seed;
  Instance instance;
  Plan optimum;
};

// Calls test(case) for about half of `rounds` random cases.
template <class Test>
void for_each_solvable(int rounds, Test test) {
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(testing::fuzz_rounds(rounds));
       ++seed) {
    SCOPED_TRACE(seed);
    Instance instance = fuzz::any_instance(seed).build();
    oracle::Answer truth = oracle::solve_jointly(instance);
    if (truth.plan) test(SolvableCase{seed, std::move(instance), *std::move(truth.plan)});
  }
}

Techniques some_splits(std::uint64_t seed) {
  Techniques techniques;
  if (seed % 3 != 0) techniques = techniques.with(Technique::kTarget);
  if (seed % 4 != 0) techniques = techniques.with(Technique::kCorridor);
  return techniques;
}

// The bound rises to the oracle's optimum and never exceeds it, on grids and roadmaps, with turning
// agents, tasks of any duration and any order, and without following.
TEST(CoreSearch, AgreesWithTheOracle) {
  int solved = 0, infeasible = 0, with_cores = 0;
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(testing::fuzz_rounds(160));
       ++seed) {
    SCOPED_TRACE(seed);
    Instance instance = fuzz::any_instance(seed).build();
    if (seed % 5 == 0) instance = instance.without_following();
    const oracle::Answer truth = oracle::solve_jointly(instance);
    if (truth.verdict == oracle::Verdict::kTooLarge) continue;
    const Cost optimum = truth.plan ? truth.plan->cost : kInfiniteCost;
    Search search(instance, some_splits(seed), seed % 2);
    const Outcome outcome =
        search.run(kInfiniteCost, truth.plan ? kToTheEnd : 40,
                   [&](const CoreSearch& so_far) { ASSERT_LE(so_far.lower_bound(), optimum); });
    if (search->cores() > 0) ++with_cores;
    if (!truth.plan) {
      ASSERT_FALSE(search->plan());
      ++infeasible;
      continue;
    }
    ++solved;
    ASSERT_EQ(outcome, Outcome::kSolved);
    ASSERT_EQ(search->lower_bound(), optimum);
    ASSERT_TRUE(search->plan());
    Solution solution;
    solution.status = Status::kOptimal;
    solution.plan = search->plan();
    solution.lower_bound = optimum;
    solution.may_follow = instance.may_follow();
    ASSERT_TRUE(check(instance, solution).empty());
  }
  EXPECT_GT(solved, 60);
  EXPECT_GT(infeasible, 3);
  EXPECT_GT(with_cores, 20);
}

// With a cutoff equal to the optimum the search proves that no plan costs less; with a cutoff of
// optimum + 1 it finds the optimum.
TEST(CoreSearch, ProvesTheCutoff) {
  int proven = 0;
  for_each_solvable(70, [&](const SolvableCase& c) {
    Search at(c.instance, some_splits(c.seed));
    EXPECT_EQ(at.run(c.optimum.cost, kToTheEnd), Outcome::kSolved);
    EXPECT_FALSE(at->plan());
    EXPECT_EQ(at->lower_bound(), c.optimum.cost);
    Search above(c.instance, some_splits(c.seed));
    EXPECT_EQ(above.run(c.optimum.cost + 1, kToTheEnd), Outcome::kSolved);
    ASSERT_TRUE(above->plan());
    EXPECT_EQ(above->plan()->cost, c.optimum.cost);
    ++proven;
  });
  EXPECT_GT(proven, 25);
}

// The cutoff falls during the search, from far above the optimum to the optimum.
TEST(CoreSearch, AcceptsAFallingCutoff) {
  for_each_solvable(70, [&](const SolvableCase& c) {
    Search search(c.instance, some_splits(c.seed));
    Cost cutoff = c.optimum.cost + 6;
    Outcome outcome = Outcome::kWorking;
    while (outcome == Outcome::kWorking) {
      outcome = search.run(cutoff, 3);
      ASSERT_LE(search->lower_bound(), c.optimum.cost);
      cutoff = std::max(c.optimum.cost, cutoff - 1);
    }
    EXPECT_EQ(outcome, Outcome::kSolved);
    EXPECT_EQ(search->lower_bound(), c.optimum.cost);
  });
}

// Statements about groups hold in optimal plans, and a search that is given them finds the same.
TEST(CoreSearch, StatementsAboutGroupsAreTrue) {
  int statements = 0;
  for_each_solvable(200, [&](const SolvableCase& c) {
    Search search(c.instance, some_splits(c.seed));
    std::vector<GroupExcess> found;
    search.run(kInfiniteCost, 1000, [&](CoreSearch& so_far) {
      for (const GroupExcess& excess : so_far.take_excesses()) found.push_back(excess);
    });
    for (const GroupExcess& excess : found) {
      Cost cost = 0;
      for (const AgentIndex agent : excess.agents)
        cost += c.optimum.agents[agent].cost - least_cost(c.instance, agent);
      ASSERT_GE(cost, excess.excess);
      ++statements;
    }
    Search again(c.instance, some_splits(c.seed + 1));
    while (!again->is_set_up()) ASSERT_EQ(again.run(c.optimum.cost + 1, 1), Outcome::kWorking);
    for (const GroupExcess& excess : found) (*again).add(excess);
    EXPECT_EQ(again.run(c.optimum.cost + 1, kToTheEnd), Outcome::kSolved);
    EXPECT_EQ(again->lower_bound(), c.optimum.cost);
  });
  EXPECT_GT(statements, 20);
}

TEST(CoreSearch, StopsAtItsMemoryLimit) {
  const Instance instance = fuzz::random_instance(4).build();
  const Limits limits;
  const Problem problem(instance, limits);
  const AgentStopsCache stops(instance, problem.distances);
  CoreSearch search(problem, stops, Techniques::defaults(), 1, limits);
  Outcome outcome = Outcome::kWorking;
  while (outcome == Outcome::kWorking) outcome = search.step(kInfiniteCost);
  EXPECT_EQ(outcome, Outcome::kTooLarge);
  EXPECT_FALSE(search.plan());
}

}  // namespace core_search_test
}  // namespace grove::detail
