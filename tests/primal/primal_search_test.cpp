// SPDX-License-Identifier: MIT
#include "primal/primal_search.h"

#include <gtest/gtest.h>

#include <chrono>
#include <random>
#include <string>
#include <vector>

#include "crowd.h"
#include "prices.h"
#include "search/feasibility.h"
#include "tests/fuzz/random_instance.h"
#include "tests/support/clocks.h"
#include "tests/support/first_violation.h"
#include "tests/support/instances.h"
#include "tests/support/sanitizers.h"

namespace grove::detail {
namespace primal_search_test {

using testing::first_violation;
using testing::instance_of;

// A primal search with its own problem. The instance must outlive it.
struct Search {
  explicit Search(const Instance& the_instance, std::uint64_t seed = 0,
                  Techniques techniques = Techniques::defaults(), const Tuning& tuning = {})
      : instance(the_instance),
        problem(instance, limits),
        stops(instance, problem.distances),
        primal(problem, stops, seed, techniques, tuning) {}

  // Runs `steps` steps and returns the plans found, each checked.
  std::vector<Plan> plans(int steps) {
    std::vector<Plan> result;
    for (int step = 0; step < steps; ++step)
      if (auto plan = primal.step(limits)) {
        EXPECT_EQ(first_violation(instance, *plan), "");
        EXPECT_EQ(plan->cost, primal.best_cost());
        EXPECT_TRUE(result.empty() || plan->cost < result.back().cost);
        result.push_back(std::move(*plan));
      }
    return result;
  }

  Limits limits;
  const Instance& instance;
  Problem problem;
  AgentStopsCache stops;
  PrimalSearch primal;
};

bool searchable(const Instance& instance) {
  return !presolve_infeasibility(Problem(instance, Limits()));
}

TEST(PrimalSearch, EveryPlanIsValid) {
  int solved = 0;
  int tried = 0;
  for (std::uint64_t seed = 0; seed < 1500; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Instance instance = fuzz::random_instance(seed).build();
    if (!searchable(instance)) continue;
    ++tried;
    Search search(instance, seed);
    if (!search.plans(6).empty()) ++solved;
    if (HasFailure()) return;
  }
  EXPECT_GT(tried, 1000);
  EXPECT_GT(solved, tried * 8 / 10);
}

TEST(PrimalSearch, SameSeedGivesTheSamePlans) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const Instance instance = fuzz::random_instance(seed).build();
    if (!searchable(instance)) continue;
    std::vector<std::int64_t> work[2];
    for (auto& counts : work) {
      Search search(instance, seed);
      for (int step = 0; step < 8; ++step) {
        const auto plan = search.primal.step(search.limits);
        counts.push_back(plan ? plan->cost : -1);
        counts.push_back(search.primal.work());
      }
    }
    EXPECT_EQ(work[0], work[1]);
  }
}

// After a stop at any limit the search resumes from a consistent state.
TEST(PrimalSearch, ResumesAfterAnyLimit) {
  std::mt19937 random(1);
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Instance instance = fuzz::random_instance(seed).build();
    if (!searchable(instance)) continue;
    Search search(instance, seed);
    for (int round = 0; round < 5; ++round) {
      const testing::ClockReadingLimit limits(random() % 20);
      for (int step = 0; step < 3; ++step)
        if (const auto plan = search.primal.step(limits)) {
          EXPECT_EQ(first_violation(instance, *plan), "");
        }
      search.plans(1);
    }
    if (HasFailure()) return;
  }
}

TEST(PrimalSearch, DoesNothingAfterTheDeadline) {
  const Instance instance = instance_of({"....."}, {{{0, 0}, Position{4, 0}, {{2, 0}}}});
  Search search(instance);
  search.limits.set_deadline(testing::kPast);
  EXPECT_FALSE(search.primal.step(search.limits));
  EXPECT_EQ(search.primal.counts().low_level_calls, 0);
  EXPECT_FALSE(search.primal.best_cost());
}

TEST(PrimalSearch, FailedAgentIsPlannedBeforeItsBlockingAgents) {
  // a0 has the shorter path and is planned first, but at its destination it encloses a1.
  const Instance instance = instance_of({"......", "@@@.@@", "@@@.@@"},
                                        {{{2, 0}, Position{3, 1}}, {{3, 2}, Position{0, 0}}});
  for (const bool keeps : {false, true}) {
    Tuning tuning;
    if (keeps) tuning.pp_resume_labels = 0;
    Search search(instance, 0, Techniques::defaults().without(Technique::kLacam), tuning);
    const std::vector<Plan> plans = search.plans(1);
    ASSERT_FALSE(plans.empty());
    EXPECT_EQ(search.primal.source(), PlanSource::kPrioritizedPlanning);
    EXPECT_EQ(search.primal.counts().attempts, keeps ? 1 : 2);
  }
}

// At the first failure of an agent only its blocking agents are re-planned; at its second failure
// planning restarts. After one label of exact search a greedy search looks for any path.
TEST(PrimalSearch, EveryPlanIsValidWithMinimalLabelLimits) {
  Tuning tuning;
  tuning.pp_resume_labels = 0;
  tuning.pp_exact_labels = 1;
  tuning.pp_exact_labels_factor = 0;
  int solved = 0;
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Instance instance = fuzz::random_instance(seed).build();
    if (!searchable(instance)) continue;
    Search search(instance, seed, Techniques::defaults().without(Technique::kLacam), tuning);
    if (!search.plans(6).empty()) ++solved;
    if (HasFailure()) return;
  }
  EXPECT_GT(solved, 250);
}

TEST(PrimalSearch, IsOptimalWhenEveryAgentHasItsIndividualPath) {
  const Instance instance =
      instance_of({"....", "...."}, {{{0, 0}, Position{3, 0}, {{1, 0}}}, {{0, 1}, Position{0, 1}}});
  Search search(instance);
  const std::vector<Plan> plans = search.plans(5);
  ASSERT_EQ(plans.size(), 1u);
  EXPECT_EQ(plans[0].cost, 3);
  EXPECT_EQ(search.primal.source(), PlanSource::kPrioritizedPlanning);
  EXPECT_TRUE(search.primal.optimal());
  const std::int64_t work = search.primal.work();
  EXPECT_TRUE(search.plans(3).empty());
  EXPECT_EQ(search.primal.work(), work);
}

// Returns two columns of agents that change sides through a wall with two doors.
Instance doors() {
  std::vector<std::string> rows(8, "....@....");
  rows[2] = rows[5] = ".........";
  std::vector<testing::AgentSpec> agents;
  for (int i = 0; i < 8; ++i) {
    agents.push_back({{0, i}, Position{8, 7 - i}, {{6, i}}});
    agents.push_back({{8, i}, Position{0, 7 - i}});
  }
  return instance_of(rows, agents);
}

TEST(PrimalSearch, ImprovesItsFirstPlan) {
  const Instance instance = doors();
  Search search(instance);
  const std::vector<Plan> plans = search.plans(200);
  ASSERT_GT(plans.size(), 2u);
  EXPECT_EQ(search.primal.source(), PlanSource::kLns);
  EXPECT_GT(search.primal.counts().neighborhoods, 100);
}

// Passes dual solutions to the search while it runs.
TEST(PrimalSearch, UsesDualSolutionsRepeatably) {
  const Instance instance = doors();
  Tuning tuning;
  tuning.lagrangian_lns_max_gap = 1;
  std::vector<std::int64_t> work[2];
  for (auto& counts : work) {
    Search search(instance, 1, Techniques::defaults(), tuning);
    for (const int rounds : {0, 15, 60}) {
      const auto prices = testing::dual_solution_of(instance, search.stops, rounds);
      EXPECT_EQ(prices == nullptr, rounds == 0);
      search.primal.use(prices);
      for (const Plan& plan : search.plans(100)) counts.push_back(plan.cost);
      counts.push_back(search.primal.work());
    }
  }
  EXPECT_EQ(work[0], work[1]);
  Search without(instance, 1);
  without.plans(300);
  EXPECT_NE(without.primal.work(), work[0].back());

  tuning.lagrangian_lns_max_gap = 0;  // above any real gap
  Search too_far(instance, 1, Techniques::defaults(), tuning);
  too_far.primal.use(testing::dual_solution_of(instance, too_far.stops, 60));
  too_far.plans(300);
  EXPECT_EQ(too_far.primal.work(), without.primal.work());
}

TEST(PrimalSearch, EveryPlanWithDualSolutionsIsValid) {
  int with_dual = 0;
  Tuning tuning;
  tuning.lagrangian_lns_max_gap = 1e6;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Instance instance = fuzz::random_instance(seed).build();
    if (!searchable(instance)) continue;
    Search search(instance, seed, Techniques::defaults(), tuning);
    const auto prices = testing::dual_solution_of(instance, search.stops, 12);
    with_dual += prices != nullptr;
    search.plans(2);
    search.primal.use(prices);
    search.plans(10);
    if (HasFailure()) return;
  }
  EXPECT_GT(with_dual, 50);
}

// Record-to-record travel accepts slightly worse plans but does not report them. The sum of its
// plan costs is less than that of pure descent.
TEST(PrimalSearch, AcceptsSlightlyWorsePlansToImproveFurther) {
  const Instance instance =
      testing::random_crowd({.size = 10, .obstacles = 10, .agents = 64, .tasks = 0}, 1);
  Cost by_descent = 0, by_walk = 0;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    Tuning walk;
    walk.record_deviation_max_loss = 10;
    Tuning descent;
    descent.record_deviation = 0;
    by_descent += Search(instance, seed, Techniques::defaults(), descent).plans(250).back().cost;
    by_walk += Search(instance, seed, Techniques::defaults(), walk).plans(250).back().cost;
  }
  EXPECT_LT(by_walk, by_descent);
}

TEST(PrimalSearch, RestartsWhenItStalls) {
  const Instance instance = doors();
  Search search(instance);
  search.plans(1500);
  EXPECT_GT(search.primal.counts().attempts, 2);
}

// About 40 % of the passable cells are occupied, so that the first attempt of prioritised planning
// usually fails.
Instance dense_instance(std::uint64_t seed) {
  return testing::random_crowd({.agents = 50, .tasks = 50, .no_destination = 20}, seed);
}

TEST(PrimalSearch, DenseInstanceGetsItsFirstPlanFromLacam) {
  int by_lacam = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Instance instance = dense_instance(seed);
    Search search(instance, seed);
    std::vector<Plan> first;
    for (int step = 0; step < 500 && first.empty(); ++step) first = search.plans(1);
    if (first.empty() || search.primal.source() != PlanSource::kLacam) continue;
    ++by_lacam;
    EXPECT_GT(search.primal.counts().joint_steps, 0);
    const std::vector<Plan> later = search.plans(60);
    ASSERT_FALSE(later.empty());
    EXPECT_LT(later.back().cost, first[0].cost);
  }
  EXPECT_GE(by_lacam, 7);
}

TEST(PrimalSearch, TakesNoJointStepsWithoutLacam) {
  const Instance instance = dense_instance(1);
  Search search(instance, 1, Techniques::defaults().without(Technique::kLacam));
  search.plans(100);
  EXPECT_EQ(search.primal.counts().joint_steps, 0);
  EXPECT_GT(search.primal.counts().attempts, 1);
}

TEST(PrimalSearch, FirstAttemptOfPlanningIsNotInterrupted) {
  const Instance instance = instance_of(
      {"....", "....", "...."},
      {{{0, 0}, Position{3, 2}, {{1, 0}}}, {{3, 0}, Position{0, 2}}, {{0, 1}, Position{3, 1}}});
  Search search(instance);
  ASSERT_FALSE(search.plans(10).empty());
  EXPECT_EQ(search.primal.counts().attempts, 1);
  EXPECT_FALSE(search.primal.expects_plan());
  EXPECT_EQ(search.primal.counts().joint_steps, 0);
}

TEST(PrimalSearch, DenseInstanceIsPlannedRepeatably) {
  const Instance instance = dense_instance(2);
  std::vector<std::int64_t> work[2];
  for (auto& counts : work) {
    Search search(instance, 3);
    for (int step = 0; step < 150; ++step) {
      const auto plan = search.primal.step(search.limits);
      counts.push_back(plan ? plan->cost : -1);
      counts.push_back(search.primal.work());
      counts.push_back(search.primal.counts().joint_steps);
    }
  }
  EXPECT_GT(work[0].back(), 0);
  EXPECT_EQ(work[0], work[1]);
}

TEST(PrimalSearch, FirstPlanSearchResumesAfterAnyLimit) {
  std::mt19937 random(4);
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Instance instance = dense_instance(seed);
    Search search(instance, seed);
    std::optional<Cost> best;
    for (int round = 0; round < 60; ++round) {
      const testing::ClockReadingLimit limits(random() % 100);
      while (limits.reason() == StopReason::kNone)
        if (const auto plan = search.primal.step(limits)) {
          EXPECT_EQ(first_violation(instance, *plan), "");
          EXPECT_TRUE(!best || plan->cost < *best);
          best = plan->cost;
        }
    }
    search.plans(5);
    if (HasFailure()) return;
  }
}

// LaCAM stops near the memory limit; all other searches continue.
TEST(PrimalSearch, MemoryShortageEndsOnlyLacam) {
#ifdef GROVE_SANITIZERS_MEMORY
  GTEST_SKIP() << "the sanitizer's own memory fills the limit";
#endif
  const Instance instance = dense_instance(1);
  Search search(instance, 1);
  Limits limits;
  testing::ManualClock clock(limits);
  limits.set_memory_limit(resident_bytes() + (std::size_t{1} << 20));
  for (int step = 0; step < 1000 && search.primal.counts().attempts < 3; ++step) {
    clock.advance(std::chrono::seconds(1));  // so that every step measures the memory
    search.primal.step(limits);
  }
  EXPECT_GE(search.primal.counts().attempts, 3);
  EXPECT_EQ(search.primal.counts().joint_steps, 0);
  EXPECT_FALSE(search.primal.expects_plan());
}

// The adopted plan has a high cost, so prioritised planning continues and often finds a better
// plan.
TEST(PrimalSearch, AdoptedPlanDoesNotEndPrioritisedPlanning) {
  int by_prioritized_planning = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const Instance instance = testing::random_crowd({.size = 16, .agents = 50}, seed);
    const Plan costly = [&] {
      Tuning tuning;
      tuning.pp_head_start = 1;
      Search donor(instance, seed, Techniques::defaults(), tuning);
      std::vector<Plan> plans;
      while (plans.empty()) plans = donor.plans(1);
      EXPECT_NE(donor.primal.source(), PlanSource::kLns);
      return plans[0];
    }();
    for (int steps : {0, 1, 2}) {
      Search search(instance, seed + 1);
      search.plans(steps);
      search.primal.adopt(costly);
      for (int step = 0; step < 40; ++step)
        if (!search.plans(1).empty() &&
            search.primal.source() == PlanSource::kPrioritizedPlanning) {
          ++by_prioritized_planning;
          break;
        }
    }
  }
  EXPECT_GT(by_prioritized_planning, 15);
}

TEST(PrimalSearch, ContinuesFromAPlanAdoptedDuringItsFirstAttempts) {
  const Instance instance = dense_instance(3);
  Search donor(instance, 8);
  std::vector<Plan> plans;
  for (int step = 0; step < 500 && plans.empty(); ++step) plans = donor.plans(1);
  ASSERT_FALSE(plans.empty());
  for (int steps = 1; steps < 12; ++steps) {
    Search search(instance, 3);
    search.plans(steps);
    const auto before = search.primal.best_cost();
    search.primal.adopt(plans[0]);
    EXPECT_LE(*search.primal.best_cost(),
              before ? std::min(*before, plans[0].cost) : plans[0].cost);
    for (const Plan& plan : search.plans(40)) EXPECT_LT(plan.cost, plans[0].cost);
  }
}

// Small steps, so that the plan is adopted while prioritised planning of a later round is in
// progress.
TEST(PrimalSearch, AdoptedPlanEndsALaterRound) {
  const Instance instance = doors();
  const Plan good = Search(instance, 1).plans(1500).back();
  Tuning tuning;
  tuning.primal_step_work = 20;
  int adopted = 0;
  for (std::uint64_t seed = 2; seed < 8; ++seed) {
    Search search(instance, seed, Techniques::defaults(), tuning);
    while (search.primal.counts().attempts < 2) search.primal.step(search.limits);
    if (good.cost >= *search.primal.best_cost()) continue;
    ++adopted;
    search.primal.adopt(good);
    EXPECT_EQ(search.primal.best_cost(), good.cost);
    const std::int64_t calls = search.primal.counts().low_level_calls;
    search.primal.step(search.limits);
    EXPECT_EQ(search.primal.counts().low_level_calls, calls);  // guided LaCAM makes none
    while (search.primal.counts().attempts < 4) search.primal.step(search.limits);
  }
  EXPECT_GT(adopted, 1);
}

TEST(PrimalSearch, AdoptsABetterPlan) {
  const Instance instance = doors();
  Plan good = [&] { return Search(instance, 1).plans(400).back(); }();
  const Plan poor = [&] { return Search(instance, 2).plans(400).front(); }();
  ASSERT_LT(good.cost, poor.cost);
  good.agents[0].path.push_back(good.agents[0].path.back());  // files can contain the final rest
  for (const int steps : {0, 1, 5}) {
    Search search(instance, 3);
    search.plans(steps);
    const auto before = search.primal.best_cost();
    search.primal.adopt(good);
    const Cost best = before ? std::min(*before, good.cost) : good.cost;
    EXPECT_EQ(search.primal.best_cost(), best);
    search.primal.adopt(poor);
    EXPECT_EQ(search.primal.best_cost(), best);
    for (const Plan& plan : search.plans(100)) EXPECT_LT(plan.cost, best);
  }
}

}  // namespace primal_search_test
}  // namespace grove::detail
