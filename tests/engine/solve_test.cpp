// SPDX-License-Identifier: MIT
#include "engine/solve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <string>
#include <vector>

#include "engine/run_observer.h"
#include "model/check.h"
#include "tests/primal/crowd.h"
#include "tests/support/clocks.h"
#include "tests/support/instances.h"

namespace grove::detail {
namespace solve_test {

using testing::AgentSpec;
using testing::instance_of;

Solution solve_to(const Instance& instance, const char* omega, const Limits& limits,
                  Policy policy = Policy::kFixed) {
  SolveOptions options;
  options.omega = Omega::parse(omega);
  options.policy = policy;
  Solution solution = solve(instance, options, limits);
  if (solution.plan) {
    const auto violations = check(instance, solution);
    EXPECT_TRUE(violations.empty()) << violations[0].json_pointer << ": " << violations[0].message;
    EXPECT_LE(solution.lower_bound, solution.plan->cost);
  }
  return solution;
}

Solution solve_to(const Instance& instance, const char* omega, Policy policy = Policy::kFixed) {
  return solve_to(instance, omega, testing::HangLimit(), policy);
}

void expect_optimal(const Instance& instance, Cost cost) {
  for (const Policy policy : {Policy::kFixed, Policy::kFree}) {
    const Solution solution = solve_to(instance, "0", policy);
    ASSERT_EQ(solution.status, Status::kOptimal);
    EXPECT_EQ(solution.plan->cost, cost);
    EXPECT_EQ(solution.lower_bound, cost);
  }
}

TEST(Solve, OneAgentTakesItsBestOrder) {
  expect_optimal(instance_of({"....."}, {{{1, 0}, Position{4, 0}, {{0, 0}, {3, 0}}}}), 5);
}

TEST(Solve, IdleAgentAtItsGoalCostsNothing) {
  expect_optimal(instance_of({"..", ".."}, {{{0, 0}, Position{0, 0}}}), 0);
}

TEST(Solve, AgentsPassInABay) {
  // One agent steps into the bay and back; the other waits one step for it.
  expect_optimal(
      instance_of({".....", "@@.@@"}, {{{0, 0}, Position{4, 0}}, {{4, 0}, Position{0, 0}}}), 11);
}

TEST(Solve, AgentLeavesItsGoalToLetAnotherPass) {
  // a1 is on its destination in the middle of the corridor and can only leave into the bay below.
  expect_optimal(
      instance_of({".....", "@@.@@"}, {{{0, 0}, Position{4, 0}}, {{2, 0}, Position{2, 0}}}), 7);
}

TEST(Solve, TaskIsVisitedBeforeAnotherAgentRestsOnIt) {
  // a0's task is a1's destination in a dead end: a0 must enter and leave before a1 rests there.
  expect_optimal(
      instance_of({"....", "@.@@"}, {{{0, 0}, Position{3, 0}, {{1, 1}}}, {{2, 0}, Position{1, 1}}}),
      5 + 5);
}

TEST(Solve, AgentWithoutDestinationChoosesItsLastTask) {
  expect_optimal(instance_of({"......."}, {{{2, 0}, {}, {{0, 0}, {6, 0}}}}), 8);
}

TEST(Solve, AgentWithoutDestinationRestsWhereOthersNeedNotPass) {
  expect_optimal(instance_of({"....."}, {{{0, 0}, Position{3, 0}}, {{1, 0}, {}, {{2, 0}, {4, 0}}}}),
                 3 + 3);
}

TEST(Solve, DetectsInfeasibilityInPresolve) {
  const Solution solution = solve_to(instance_of({".@."}, {{{0, 0}, Position{2, 0}}}), "0");
  EXPECT_EQ(solution.status, Status::kInfeasible);
  EXPECT_FALSE(solution.plan);
}

TEST(Solve, ConflictFreeFirstTreeNeedsNoSecond) {
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

TEST(Solve, DetectsThatAgentsLackRoomToPass) {
  // A tree-shaped map in which the agents have no room to pass each other.
  const Solution solution = solve_to(
      instance_of({"...", "@.@"},
                  {{{0, 0}, Position{2, 0}}, {{2, 0}, Position{1, 1}}, {{1, 0}, Position{0, 0}}}),
      "0");
  EXPECT_EQ(solution.status, Status::kInfeasible);
  EXPECT_FALSE(solution.stats.texts.at("reason").empty());
}

TEST(Solve, ExpiredDeadlineStillGivesALowerBound) {
  const Instance instance = instance_of({"....."}, {{{0, 0}, Position{4, 0}, {{2, 0}}}});
  const Solution solution = solve_to(instance, "0", testing::ClockReadingLimit(0));
  EXPECT_EQ(solution.status, Status::kUnknown);
  EXPECT_LE(solution.lower_bound, 4);
}

TEST(Solve, TinyMemoryLimitEndsTheRunCleanly) {
  Limits limits;
  limits.set_memory_limit(1);
  const Solution solution =
      solve(instance_of({"....."}, {{{0, 0}, Position{4, 0}, {{2, 0}}}}), SolveOptions(), limits);
  EXPECT_EQ(solution.status, Status::kUnknown);
  EXPECT_EQ(solution.stats.texts.at("stopped_by"), "memory limit");
}

// Interrupts the run after a given number of expansions.
class Interrupter : public RunObserver {
 public:
  explicit Interrupter(int after) : left_(after) {}
  void on_expanded(const NodePtr&, const Expansion&, int) override {
    if (--left_ == 0) flag = true;
  }
  std::atomic<bool> flag{false};

 private:
  int left_;
};

TEST(Solve, InterruptKeepsTheBound) {
  Interrupter interrupter(20);
  Limits limits;
  limits.watch_interrupt(&interrupter.flag);
  const Instance instance =
      testing::random_crowd({.size = 8, .obstacles = 10, .agents = 12, .tasks = 12}, 1);
  SolveOptions options;
  options.techniques = Techniques();  // plain CBS, which expands more nodes
  const Solution solution = solve(instance, options, limits, &interrupter);
  EXPECT_EQ(solution.status, Status::kUnknown);
  EXPECT_EQ(solution.stats.texts.at("stopped_by"), "interrupt");
  EXPECT_GT(solution.lower_bound, 0);
}

// Expects that the reported lower bound never falls.
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

TEST(Solve, ReportedBoundNeverFalls) {
  BoundWatcher watcher;
  const Instance instance =
      instance_of({".....", "@@.@@", "....."}, {{{0, 0}, Position{4, 2}, {{4, 0}, {0, 2}}},
                                                {{4, 0}, Position{0, 2}, {{0, 0}}},
                                                {{0, 2}, Position{4, 0}, {{4, 2}}}});
  const Solution solution = solve(instance, SolveOptions(), testing::HangLimit(), &watcher);
  EXPECT_NE(solution.status, Status::kInfeasible);
}

// Returns an instance whose agents change sides through two doors. The tree search finds no plan
// within seconds.
Instance two_doors() {
  std::vector<std::string> rows(10, "....@....");
  rows[2] = rows[6] = ".........";
  std::vector<AgentSpec> agents;
  for (int i = 0; i < 10; ++i) {
    agents.push_back({{0, i}, Position{8, 9 - i}, {{6, i}}});
    agents.push_back({{8, i}, Position{0, 9 - i}});
  }
  return instance_of(rows, agents);
}

// Records the incumbents of a run and sets `flag` after `stop_after` of them.
class IncumbentWatcher : public RunObserver {
 public:
  void on_incumbent(const Plan& plan, PlanSource source, const Progress& progress) override {
    EXPECT_EQ(plan.cost, progress.incumbent);
    EXPECT_TRUE(costs.empty() || plan.cost < costs.back());
    costs.push_back(plan.cost);
    sources.push_back(source);
    if (static_cast<int>(costs.size()) == stop_after) flag = true;
  }
  void on_event(RunEvent event, const Progress& progress) override {
    if (event != RunEvent::kIncumbent) return;
    ++announced;
    EXPECT_EQ(progress.incumbent, costs.back());
    EXPECT_EQ(announced, costs.size());
  }

  std::atomic<bool> flag{false};
  int stop_after = -1;
  std::size_t announced = 0;
  std::vector<Cost> costs;
  std::vector<PlanSource> sources;
};

// Solves until the run has found `incumbents` incumbents.
Solution solve_until(const Instance& instance, const SolveOptions& options,
                     IncumbentWatcher& watcher, int incumbents) {
  testing::HangLimit limits;
  limits.watch_interrupt(&watcher.flag);
  watcher.stop_after = incumbents;
  return solve(instance, options, limits, &watcher);
}

TEST(Solve, PrimalSearchFindsAndImprovesPlans) {
  const Instance instance = two_doors();
  IncumbentWatcher watcher;
  const Solution solution = solve_until(instance, SolveOptions(), watcher, 5);
  ASSERT_TRUE(solution.plan);
  EXPECT_TRUE(check(instance, solution).empty());
  EXPECT_EQ(watcher.sources.front(), PlanSource::kPrioritizedPlanning);
  EXPECT_EQ(watcher.sources.back(), PlanSource::kLns);
  EXPECT_GT(solution.stats.counts.at("primal_low_level_calls"), 0);
  EXPECT_GT(solution.stats.counts.at("primal_lns_iterations"), 0);
}

TEST(Solve, IncumbentsAreCountedBySource) {
  IncumbentWatcher watcher;
  auto counts = solve_until(two_doors(), SolveOptions(), watcher, 5).stats.counts;
  ASSERT_GT(watcher.costs.size(), 1u);
  Cost gain = 0;
  for (std::size_t source = 0; source < kPlanSources.size(); ++source) {
    const std::string name(kPlanSources[source]);
    EXPECT_EQ(counts["plans_" + name],
              std::ranges::count(watcher.sources, static_cast<PlanSource>(source)));
    gain += counts["gain_" + name];
  }
  EXPECT_EQ(gain, watcher.costs.front() - watcher.costs.back());
}

TEST(Solve, TwoRunsFindTheSamePlans) {
  const Instance instance = two_doors();
  IncumbentWatcher first;
  IncumbentWatcher second;
  IncumbentWatcher other_seed;
  SolveOptions options;
  options.seed = 7;
  solve_until(instance, options, first, 8);
  solve_until(instance, options, second, 8);
  EXPECT_EQ(first.costs, second.costs);
  options.seed = 8;
  solve_until(instance, options, other_seed, 8);
  EXPECT_NE(first.costs, other_seed.costs);
}

TEST(Solve, PrimalSearchIsOffIfDisabledAndForTheFixedPolicy) {
  const Instance instance = two_doors();
  SolveOptions without;
  without.techniques = Techniques::defaults().without(Technique::kPrimal);
  SolveOptions fixed;
  fixed.policy = Policy::kFixed;
  for (const SolveOptions& options : {without, fixed}) {
    const testing::ClockReadingLimit limits(10'000);
    const Solution solution = solve(instance, options, limits);
    EXPECT_GT(solution.stats.counts.at("nodes_expanded"), 0);
    EXPECT_EQ(solution.stats.counts.at("primal_steps"), 0);
  }
}

TEST(Solve, LacamCanBeDisabledSeparately) {
  const Instance instance = testing::random_crowd({.agents = 50, .tasks = 50}, 1);
  for (const bool with : {true, false}) {
    SolveOptions options;
    if (!with) options.techniques = options.techniques.without(Technique::kLacam);
    const testing::ClockReadingLimit limits(20'000);
    const Solution solution = solve(instance, options, limits);
    EXPECT_GT(solution.stats.counts.at("primal_attempts"), 1);
    EXPECT_EQ(solution.stats.counts.at("primal_lacam_steps") > 0, with);
    EXPECT_TRUE(!with || solution.plan);
    if (solution.plan) {
      EXPECT_TRUE(check(instance, solution).empty());
    }
  }
}

TEST(Solve, StartPlanIsTheFirstIncumbent) {
  const Instance instance = two_doors();
  IncumbentWatcher watcher;
  SolveOptions options;
  const Solution poor = solve_until(instance, options, watcher, 3);
  ASSERT_TRUE(poor.plan);
  options.start = poor.plan;
  for (const Policy policy : {Policy::kFixed, Policy::kFree}) {
    options.policy = policy;
    IncumbentWatcher again;
    const int incumbents = policy == Policy::kFixed ? 1 : 3;
    const Solution solution = solve_until(instance, options, again, incumbents);
    EXPECT_EQ(again.costs.front(), poor.plan->cost);
    EXPECT_EQ(again.sources.front(), PlanSource::kStart);
    if (policy == Policy::kFree) {
      EXPECT_LT(solution.plan->cost, poor.plan->cost);
    }
  }
}

TEST(Solve, OptimalStartPlanEndsTheRunOnceTheBoundReachesIt) {
  const Instance instance =
      instance_of({".....", "@@.@@"}, {{{0, 0}, Position{4, 0}}, {{4, 0}, Position{0, 0}}});
  const Solution best = solve_to(instance, "0", Policy::kFree);
  for (const Policy policy : {Policy::kFixed, Policy::kFree}) {
    SolveOptions options;
    options.policy = policy;
    options.start = best.plan;
    IncumbentWatcher watcher;
    const Solution solution = solve(instance, options, Limits(), &watcher);
    EXPECT_EQ(solution.status, Status::kOptimal);
    EXPECT_EQ(solution.lower_bound, 11);
    EXPECT_EQ(watcher.costs, std::vector<Cost>{11});
  }
}

TEST(Solve, StartPlanIsReturnedAfterAnExpiredDeadline) {
  const Instance instance =
      instance_of({".....", "@@.@@"}, {{{0, 0}, Position{4, 0}}, {{4, 0}, Position{0, 0}}});
  SolveOptions options;
  options.start = solve_to(instance, "0", Policy::kFree).plan;
  Limits limits;
  limits.set_deadline(testing::kPast);
  const Solution solution = solve(instance, options, limits);
  EXPECT_EQ(solution.status, Status::kFeasible);
  EXPECT_EQ(solution.plan->cost, 11);
  EXPECT_LE(solution.lower_bound, 11);
}

TEST(Solve, InvalidStartPlanIsRefused) {
  const Instance instance = two_doors();
  SolveOptions options;
  options.start = Plan{1, std::vector<AgentPlan>(20)};
  EXPECT_THROW(solve(instance, options, Limits()), std::logic_error);
}

}  // namespace solve_test
}  // namespace grove::detail
