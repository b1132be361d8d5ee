// SPDX-License-Identifier: MIT
// GROVE_FUZZ_FACTOR multiplies the number of random instances.
#include "primal/lacam_with_restarts.h"

#include <gtest/gtest.h>

#include <atomic>
#include <limits>
#include <numeric>

#include "crowd.h"
#include "model/check.h"
#include "primal/visit_orders.h"
#include "tests/fuzz/random_instance.h"
#include "tests/oracle/joint_oracle.h"
#include "tests/support/clocks.h"
#include "tests/support/fuzz_factor.h"
#include "tests/support/instances.h"

namespace grove::detail {
namespace lacam_with_restarts_test {

using testing::AgentSpec;
using testing::Crowd;
using testing::instance_of;
using testing::random_crowd;
using Outcome = LacamWithRestarts::Outcome;

constexpr std::int64_t kWithoutEnd = std::numeric_limits<std::int64_t>::max();

// A search with its own problem. The instance must outlive it.
struct Trial {
  explicit Trial(const Instance& the_instance, std::uint64_t seed = 0)
      : instance(the_instance),
        problem(instance, limits),
        search(problem, *cheapest_orders(problem, limits), seed) {}

  Outcome run(std::int64_t slice) { return search.run(limits, slice); }
  Outcome run() { return run(kWithoutEnd); }

  const Instance& instance;
  Limits limits;
  Problem problem;
  LacamWithRestarts search;
};

void expect_valid(const Instance& instance, const std::optional<Plan>& plan) {
  ASSERT_TRUE(plan);
  Solution solution;
  solution.status = status_of(plan->cost, 0, solution.omega);
  solution.plan = plan;
  const auto violations = check(instance, solution);
  EXPECT_TRUE(violations.empty()) << violations[0].json_pointer << ": " << violations[0].message;
}

// Runs the search to its end, expects a valid plan and returns its cost.
Cost solved_cost(const Instance& instance) {
  Trial run(instance);
  EXPECT_EQ(run.run(), Outcome::kFound);
  expect_valid(instance, run.search.plan());
  return run.search.plan() ? run.search.plan()->cost : -1;
}

bool same_plan(const Plan& a, const Plan& b) {
  return a.cost == b.cost &&
         std::ranges::equal(a.agents, b.agents, {}, &AgentPlan::path, &AgentPlan::path);
}

TEST(LacamWithRestarts, SingleAgentTakesItsCheapestOrder) {
  EXPECT_EQ(solved_cost(instance_of({"......"}, {{{2, 0}, Position{3, 0}, {{5, 0}, {0, 0}}}})), 9);
  EXPECT_EQ(solved_cost(instance_of({"......"}, {{{2, 0}, {}, {{5, 0}, {0, 0}}}})), 7);
}

TEST(LacamWithRestarts, NoAgentMovesIfAllStartAtTheirGoals) {
  EXPECT_EQ(solved_cost(
                instance_of({".."}, {{{0, 0}, Position{0, 0}, {{0, 0}}}, {{1, 0}, {}, {{1, 0}}}})),
            0);
}

TEST(LacamWithRestarts, AgentsRotateOnARing) {
  EXPECT_EQ(solved_cost(instance_of({"..", ".."}, {{{0, 0}, Position{1, 0}},
                                                   {{1, 0}, Position{1, 1}},
                                                   {{1, 1}, Position{0, 1}},
                                                   {{0, 1}, Position{0, 0}}})),
            4);
}

TEST(LacamWithRestarts, AgentsSwapAtABay) {
  solved_cost(
      instance_of({".......", "@@@@@.@"}, {{{0, 0}, Position{6, 0}}, {{2, 0}, Position{0, 0}}}));
}

TEST(LacamWithRestarts, AgentLeavesADeadEndInWhichAnotherHasATask) {
  // a1 reaches its goal at the end of the dead end before a0 has been there, so a1 must come out
  // again.
  solved_cost(instance_of({"@.@@@@@@@@", "..........", "@.@@@@@@@@", "@.@@@@@@@@"},
                          {{{9, 1}, Position{0, 1}, {{1, 3}}}, {{1, 0}, Position{1, 3}}}));
}

TEST(LacamWithRestarts, AgentsEndOnDifferentStops) {
  solved_cost(
      instance_of({".....", "....."}, {{{0, 0}, {}, {{3, 0}, {4, 0}}}, {{1, 0}, {}, {{4, 0}}}}));
}

TEST(LacamWithRestarts, IsExhaustedIfAStopIsUnreachable) {
  const Instance instance = instance_of({".@."}, {{{0, 0}, Position{0, 0}, {{2, 0}}}});
  EXPECT_EQ(Trial(instance).run(), Outcome::kExhausted);
}

TEST(LacamWithRestarts, RefusesIncompleteOrders) {
  const Instance instance = instance_of({"..."}, {{{0, 0}, Position{0, 0}, {{1, 0}, {2, 0}}}});
  const Problem problem(instance, Limits());
  for (const std::vector<Sequence>& orders :
       {std::vector<Sequence>{}, {{0}}, {{0, 0}}, {{0, 2}}, {{0, 1}, {0, 1}}})
    EXPECT_THROW(LacamWithRestarts(problem, orders, 0), std::invalid_argument);
}

// The search must find a plan for an instance if and only if the oracle finds one.
TEST(LacamWithRestarts, SolvesExactlyTheFeasibleTinyInstances) {
  int solved = 0;
  int impossible = 0;
  const std::uint64_t cases = testing::fuzz_rounds(600);
  for (std::uint64_t seed = 0; seed < cases; ++seed) {
    const Instance instance = fuzz::random_instance(seed).build();
    const oracle::Answer truth = oracle::solve_jointly(instance, 20'000);
    if (truth.verdict == oracle::Verdict::kTooLarge) continue;
    Trial run(instance, seed);
    const Outcome outcome = run.run();
    ASSERT_EQ(outcome, truth.plan ? Outcome::kFound : Outcome::kExhausted) << "seed " << seed;
    if (truth.plan) {
      expect_valid(instance, run.search.plan());
      EXPECT_GE(run.search.plan()->cost, truth.plan->cost) << "seed " << seed;
    }
    ++(truth.plan ? solved : impossible);
  }
  EXPECT_GT(solved, 100);
  EXPECT_GT(impossible, 10);
}

class DenseInstances : public ::testing::TestWithParam<Crowd> {};

// A few of these random dense instances have no plan, or none that is found soon.
TEST_P(DenseInstances, GetAValidPlan) {
  const std::uint64_t cases = testing::fuzz_rounds(10);
  std::uint64_t unsolved = 0;
  for (std::uint64_t seed = 0; seed < cases; ++seed) {
    const Instance instance = random_crowd(GetParam(), seed);
    Trial run(instance, seed);
    if (run.run(20'000) == Outcome::kFound)
      expect_valid(instance, run.search.plan());
    else
      ++unsolved;
  }
  EXPECT_LE(unsolved, 1 + cases / 50);
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, DenseInstances,
    ::testing::Values(Crowd{.tasks = 0}, Crowd{.agents = 50, .tasks = 50},
                      Crowd{.agents = 30, .tasks = 60, .no_destination = 100},
                      Crowd{.agents = 30, .tasks = 40, .no_destination = 40},
                      Crowd{.size = 20, .obstacles = 25, .agents = 60, .tasks = 60},
                      Crowd{.agents = 6, .tasks = 70}));

TEST(LacamWithRestarts, PlanDependsOnTheSeedButNotOnTheSlices) {
  const Instance instance = random_crowd({.agents = 40}, 1);
  Trial whole(instance, 7);
  ASSERT_EQ(whole.run(), Outcome::kFound);
  Trial sliced(instance, 7);
  int slices = 1;
  for (; sliced.run(slices) == Outcome::kWorking; ++slices) EXPECT_FALSE(sliced.search.plan());
  EXPECT_GT(slices, 2);
  EXPECT_TRUE(same_plan(*whole.search.plan(), *sliced.search.plan()));
  EXPECT_EQ(whole.search.configurations(), sliced.search.configurations());

  Trial other(instance, 8);
  ASSERT_EQ(other.run(), Outcome::kFound);
  EXPECT_FALSE(same_plan(*whole.search.plan(), *other.search.plan()));
}

// Agents would have to pass each other in a tree without room. There is no plan, and there are too
// many joint states to enumerate.
Instance infeasible_instance() {
  return instance_of({".........", "@.@.@.@.@", "@.@.@.@.@"}, {{{0, 0}, Position{8, 0}},
                                                               {{8, 0}, Position{0, 0}},
                                                               {{1, 2}, Position{1, 1}},
                                                               {{1, 1}, Position{1, 2}},
                                                               {{3, 2}, Position{3, 1}},
                                                               {{3, 1}, Position{3, 2}},
                                                               {{5, 2}, Position{5, 1}},
                                                               {{5, 1}, Position{5, 2}},
                                                               {{7, 2}, Position{7, 1}},
                                                               {{7, 1}, Position{7, 2}},
                                                               {{4, 0}, Position{4, 0}}});
}

TEST(LacamWithRestarts, RestartsWhenItTakesLong) {
  const Instance instance = infeasible_instance();
  Trial run(instance);
  std::int64_t configurations = 0;
  int restarts = 0;
  for (int slice = 0; slice < 40; ++slice) {
    ASSERT_EQ(run.run(1000), Outcome::kWorking);
    restarts += run.search.configurations() < configurations;
    configurations = run.search.configurations();
  }
  EXPECT_GE(restarts, 2);
  EXPECT_LE(restarts, 4);
}

TEST(LacamWithRestarts, StopsAtLimitsAndResumesAfterwards) {
  const Instance instance = random_crowd({.agents = 40}, 2);
  Trial whole(instance);
  ASSERT_EQ(whole.run(), Outcome::kFound);
  fuzz::Random random(3);
  for (int i = 0; i < 20; ++i) {
    Trial run(instance);
    const Outcome before = run.run(random.below(100));
    const std::int64_t configurations = run.search.configurations();
    const std::atomic<bool> interrupted{true};
    Limits interrupt;
    interrupt.watch_interrupt(&interrupted);
    EXPECT_EQ(run.search.run(interrupt, kWithoutEnd),
              before == Outcome::kFound ? Outcome::kFound : Outcome::kStopped);
    EXPECT_EQ(run.search.configurations(), configurations);
    ASSERT_EQ(run.run(), Outcome::kFound);
    EXPECT_TRUE(same_plan(*whole.search.plan(), *run.search.plan()));
  }
}

TEST(LacamWithRestarts, StopsBeforeTheMemoryLimitIsReached) {
  const Instance instance = infeasible_instance();
  Trial run(instance);
  Limits limits;
  limits.set_memory_limit(resident_bytes() + (std::size_t{16} << 20));
  EXPECT_EQ(run.search.run(limits, kWithoutEnd), Outcome::kStopped);
  EXPECT_EQ(limits.reason(), StopReason::kNone);
}

TEST(LacamWithRestarts, StopsAtADeadline) {
  const Instance instance = infeasible_instance();
  Trial run(instance);
  const testing::ClockReadingLimit limits(5);
  EXPECT_EQ(run.search.run(limits, kWithoutEnd), Outcome::kStopped);
  EXPECT_EQ(limits.reason(), StopReason::kTime);
}

}  // namespace lacam_with_restarts_test
}  // namespace grove::detail
