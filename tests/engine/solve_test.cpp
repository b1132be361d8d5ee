// SPDX-License-Identifier: MIT
#include "grove/engine/solve.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>

#include "grove/engine/run_observer.h"
#include "grove/model/check.h"
#include "tests/support/instances.h"

namespace grove {
namespace {

using testing::AgentSpec;
using testing::instance_of;

Solution solve_to(const Instance& instance, const char* omega, double seconds = 20,
                  Policy policy = Policy::kFixed) {
  Limits limits;
  limits.set_deadline(Limits::Clock::now() + std::chrono::duration_cast<Limits::Clock::duration>(
                                                 std::chrono::duration<double>(seconds)));
  SolveOptions options;
  options.omega = Omega::parse(omega);
  options.policy = policy;
  Solution solution = solve(instance, options, limits);
  if (solution.plan) {
    const auto violations = check(instance, solution);
    EXPECT_TRUE(violations.empty()) << violations[0].place << ": " << violations[0].message;
    EXPECT_LE(solution.lower_bound, solution.plan->cost);
  }
  return solution;
}

void expect_optimal(const Instance& instance, Cost cost) {
  for (const Policy policy : {Policy::kFixed, Policy::kFree}) {
    const Solution solution = solve_to(instance, "0", 20, policy);
    ASSERT_EQ(solution.status, Status::kOptimal);
    EXPECT_EQ(solution.plan->cost, cost);
    EXPECT_EQ(solution.lower_bound, cost);
  }
}

TEST(Solve, OneAgentTakesItsBestOrder) {
  expect_optimal(instance_of({"....."}, {{{1, 0}, Position{4, 0}, {{0, 0}, {3, 0}}}}), 5);
}

TEST(Solve, AnAgentAtItsGoalWithNothingToDoCostsNothing) {
  expect_optimal(instance_of({"..", ".."}, {{{0, 0}, Position{0, 0}}}), 0);
}

TEST(Solve, AgentsPassInABay) {
  // One of the two steps aside, in and out, and the other has to wait a step for it.
  expect_optimal(
      instance_of({".....", "@@.@@"}, {{{0, 0}, Position{4, 0}}, {{4, 0}, Position{0, 0}}}), 11);
}

TEST(Solve, AnAgentLeavesItsGoalToLetAnotherPass) {
  // a1 stands on its destination in the corridor's middle; the bay below it is the only place to
  // go.
  expect_optimal(
      instance_of({".....", "@@.@@"}, {{{0, 0}, Position{4, 0}}, {{2, 0}, Position{2, 0}}}), 7);
}

TEST(Solve, ATaskUnderARestingAgentIsVisitedBefore) {
  // a0's task is a1's destination in a dead end: a0 must go in and out before a1 rests there.
  expect_optimal(
      instance_of({"....", "@.@@"}, {{{0, 0}, Position{3, 0}, {{1, 1}}}, {{2, 0}, Position{1, 1}}}),
      5 + 5);
}

TEST(Solve, AnMgAgentChoosesItsLastTask) {
  expect_optimal(instance_of({"......."}, {{{2, 0}, {}, {{0, 0}, {6, 0}}}}), 8);
}

TEST(Solve, AnMgAgentMayNotRestWhereAnotherMustPass) {
  expect_optimal(instance_of({"....."}, {{{0, 0}, Position{3, 0}}, {{1, 0}, {}, {{2, 0}, {4, 0}}}}),
                 3 + 3);
}

TEST(Solve, SeesEvidentInfeasibility) {
  const Solution solution = solve_to(instance_of({".@."}, {{{0, 0}, Position{2, 0}}}), "0");
  EXPECT_EQ(solution.status, Status::kInfeasible);
  EXPECT_FALSE(solution.plan);
}

TEST(Solve, AConflictFreeFirstTreeNeedsNoSecond) {
  const Solution solution =
      solve_to(instance_of({"....", "...."}, {{{0, 0}, Position{3, 0}, {{1, 0}, {2, 0}}},
                                              {{0, 1}, Position{3, 1}, {{1, 1}, {2, 1}}}}),
               "0");
  EXPECT_EQ(solution.status, Status::kOptimal);
  EXPECT_EQ(solution.stats.counts.at("roots_generated"), 1);
}

TEST(Solve, InfiniteOmegaBuildsOneTree) {
  const Instance instance = instance_of(
      {".....", "@@.@@"},
      {{{0, 0}, Position{4, 0}, {{1, 0}, {3, 0}}}, {{4, 0}, Position{0, 0}, {{1, 0}, {3, 0}}}});
  const Solution solution = solve_to(instance, "inf");
  ASSERT_TRUE(solution.plan);
  EXPECT_NE(solution.status, Status::kBounded);
  EXPECT_EQ(solution.stats.counts.at("roots_generated"), 1);
}

TEST(Solve, AnUnsolvablePuzzleEndsAtTheLimitAsUnknown) {
  // A dead-end tree without room to pass; not one of the cases that are seen beforehand.
  const Solution solution = solve_to(
      instance_of({"...", "@.@"},
                  {{{0, 0}, Position{2, 0}}, {{2, 0}, Position{1, 1}}, {{1, 0}, Position{0, 0}}}),
      "0", 0.2);
  EXPECT_EQ(solution.status, Status::kUnknown);
  EXPECT_GT(solution.lower_bound, 0);
}

TEST(Solve, AnExpiredDeadlineStillBoundsFromBelow) {
  const Instance instance = instance_of({"....."}, {{{0, 0}, Position{4, 0}, {{2, 0}}}});
  const Solution solution = solve_to(instance, "0", 0);
  EXPECT_EQ(solution.status, Status::kUnknown);
  EXPECT_LE(solution.lower_bound, 4);
}

TEST(Solve, ATinyMemoryLimitEndsCleanly) {
  Limits limits;
  limits.set_memory_limit(1);
  const Solution solution =
      solve(instance_of({"....."}, {{{0, 0}, Position{4, 0}, {{2, 0}}}}), SolveOptions(), limits);
  EXPECT_EQ(solution.status, Status::kUnknown);
  EXPECT_EQ(solution.stats.texts.at("stopped_by"), "memory limit");
}

// Interrupts the run after a number of expansions.
class Interrupter : public RunObserver {
 public:
  explicit Interrupter(int after) : left_(after) {}
  void on_expanded(const NodePtr&, const Expansion&) override {
    if (--left_ == 0) flag = true;
  }
  std::atomic<bool> flag{false};

 private:
  int left_;
};

TEST(Solve, AnInterruptKeepsTheBound) {
  Interrupter interrupter(20);
  Limits limits;
  limits.watch_interrupt(&interrupter.flag);
  const Instance instance =
      instance_of({"...", "@.@"},
                  {{{0, 0}, Position{2, 0}}, {{2, 0}, Position{1, 1}}, {{1, 0}, Position{0, 0}}});
  const Solution solution = solve(instance, SolveOptions(), limits, &interrupter);
  EXPECT_EQ(solution.status, Status::kUnknown);
  EXPECT_EQ(solution.stats.texts.at("stopped_by"), "interrupt");
  EXPECT_GE(solution.lower_bound, 4);
}

// The bound a run reports must never fall.
class BoundWatcher : public RunObserver {
 public:
  void on_event(RunEvent, const Progress& progress) override {
    EXPECT_GE(progress.lower_bound, last_);
    last_ = progress.lower_bound;
    EXPECT_LE(progress.lower_bound, progress.incumbent.value_or(kInfiniteCost));
  }

 private:
  Cost last_ = 0;
};

TEST(Solve, TheReportedBoundNeverFalls) {
  BoundWatcher watcher;
  const Instance instance =
      instance_of({".....", "@@.@@", "....."}, {{{0, 0}, Position{4, 2}, {{4, 0}, {0, 2}}},
                                                {{4, 0}, Position{0, 2}, {{0, 0}}},
                                                {{0, 2}, Position{4, 0}, {{4, 2}}}});
  Limits limits;
  limits.set_deadline(Limits::Clock::now() + std::chrono::seconds(5));
  const Solution solution = solve(instance, SolveOptions(), limits, &watcher);
  EXPECT_NE(solution.status, Status::kInfeasible);
}

}  // namespace
}  // namespace grove
