// SPDX-License-Identifier: MIT
// Compares runs on tiny instances with choices with the oracle.
#include "engine/choices.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <span>

#include "assignment/priced_instance.h"
#include "engine/method.h"
#include "model/check.h"
#include "search/proof_log.h"
#include "tests/fuzz/random_instance.h"
#include "tests/oracle/joint_oracle.h"
#include "tests/support/choices.h"
#include "tests/support/clocks.h"
#include "tests/support/fuzz_factor.h"
#include "tests/support/random_choices.h"

namespace grove::detail {
namespace choices_test {

constexpr std::size_t kStates = 20'000;

// Keeps the greatest bound that formulas prove, and counts the statements of other searches.
class BoundLog : public ProofLog {
 public:
  Cost proven = 0;
  int others = 0;

  void tree(const ProofTree& /*tree*/) override { ++others; }
  void split(const ProofSplit& /*split*/) override { ++others; }
  void bound(ProofKey /*node*/, Cost /*cost*/, Cost /*bound*/,
             std::span<const ProofExcess> /*excesses*/) override {
    ++others;
  }
  void lemma(const ProofLemma& /*lemma*/, ProofKey /*root*/,
             std::span<const ProofSplit> /*splits*/) override {
    ++others;
  }
  void prices(Cost /*bound*/, std::span<const RowMultiplier> /*rows*/) override { ++others; }
  void joint(Cost /*bound*/) override { ++others; }
  void formula(FormulaKind /*kind*/, std::span<const std::int64_t> /*numbers*/) override {}
  void formula_bound(Cost bound) override { proven = std::max(proven, bound); }
};

// Plain CBS can take very long for a few of the instances.
constexpr int kClockReadings = 5000;

TEST(SolveWithChoices, AgreesWithTheOracle) {
  int instances = 0;
  int optimal = 0;
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(testing::fuzz_rounds(100));
       ++seed) {
    SCOPED_TRACE(seed);
    const Instance instance = with_random_choices(fuzz::any_instance(seed).build(), seed);
    if (!instance.has_choices()) continue;
    const oracle::Answer truth = oracle::solve_jointly(instance, kStates);
    if (!truth.plan) continue;  // the search might not end
    SolveOptions options;
    options.seed = seed;
    const Solution solution = solve_by(Method::kAuto, false, instance, options, Limits());
    ++instances;
    EXPECT_LE(solution.lower_bound, truth.plan->cost);
    if (!solution.plan) continue;
    EXPECT_EQ(check(instance, solution).size(), 0u);
    EXPECT_GE(solution.plan->cost, truth.plan->cost);
    optimal += solution.status == Status::kOptimal ? 1 : 0;
  }
  EXPECT_GT(instances, 25);
  EXPECT_GT(20 * optimal, 19 * instances);  // the others start at work
}

// The bound of a search without cores would hold, but no formula proves it.
TEST(SolveWithChoices, ReportsOnlyProvenBoundsWithAProof) {
  int optimal = 0;
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(testing::fuzz_rounds(30));
       ++seed) {
    SCOPED_TRACE(seed);
    const Instance instance = with_random_choices(fuzz::any_instance(seed).build(), seed);
    if (!instance.has_choices() || find_uncertified_choice(instance)) continue;
    if (!oracle::solve_jointly(instance, kStates).plan) continue;  // the search might not end
    for (const bool has_cores : {false, true}) {
      BoundLog log;
      SolveOptions options;
      options.seed = seed;
      options.proof = &log;
      if (!has_cores) options.techniques = Techniques::defaults().without(Technique::kCores);
      const Solution solution = solve_by(Method::kAuto, false, instance, options, Limits());
      EXPECT_LE(solution.lower_bound, log.proven);
      EXPECT_EQ(log.others, 0);
      optimal += solution.status == Status::kOptimal ? 1 : 0;
      if (!has_cores) {
        EXPECT_EQ(log.proven, 0);
      }
    }
  }
  EXPECT_GT(optimal, 3);
}

SolveOptions with_policy(Policy policy) {
  SolveOptions options;
  options.policy = policy;
  return options;
}

// Policy fixed is exact. Returns whether the run ended before the limit, with an optimal plan.
bool finds_optimum(const Instance& instance, Cost optimum) {
  SolveOptions options = with_policy(Policy::kFixed);
  options.audit = true;
  const testing::ClockReadingLimit limits(kClockReadings);
  const Solution solution = solve_by(Method::kAuto, false, instance, options, limits);
  EXPECT_LE(solution.lower_bound, optimum);
  if (solution.stats.texts.contains("stopped_by")) return false;
  EXPECT_EQ(check(instance, solution).size(), 0u);
  EXPECT_EQ(solution.status, Status::kOptimal);
  EXPECT_EQ(solution.plan ? solution.plan->cost : -1, optimum);
  return true;
}

bool fits_policy_fixed(const Instance& instance) {
  try {
    require_choices_fit(instance, with_policy(Policy::kFixed));
    return instance.has_choices();
  } catch (const InstanceError&) {
    return false;
  }
}

TEST(SolveWithChoices, PolicyFixedFindsTheOptimum) {
  int solvable = 0;
  int solved = 0;
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(testing::fuzz_rounds(100));
       ++seed) {
    SCOPED_TRACE(seed);
    const Instance instance = with_random_choices(fuzz::any_instance(seed).build(), seed);
    if (!fits_policy_fixed(instance)) continue;
    const oracle::Answer truth = oracle::solve_jointly(instance, kStates);
    if (!truth.plan) continue;
    ++solvable;
    if (finds_optimum(instance, truth.plan->cost)) ++solved;
  }
  EXPECT_GT(solvable, 20);
  EXPECT_GT(solved, solvable * 8 / 10);
}

// Agent a must visit s and rest on a task that it has visited. Agent b must pass s, so a moves on
// to t, which it may visit.
TEST(SolveWithChoices, PolicyFixedLetsAgentsRestOnOptionalTasks) {
  InstanceBuilder builder(Grid(5, 1, std::vector<bool>(5, true)));
  builder.add_agent({.id = "a", .start = {.place = 1}, .goal = {}});
  builder.add_agent({.id = "b", .start = {.place = 0}, .goal = Place{3}});
  const std::vector<std::string> a{"a"};
  const std::vector<std::string> both{"a", "b"};
  builder.add_task("s", Place{2}, a);
  builder.add_task("t", Place{4}, both, 0, 1);
  const Instance instance = std::move(builder).build();
  const oracle::Answer truth = oracle::solve_jointly(instance, kStates);
  ASSERT_TRUE(truth.plan);
  EXPECT_EQ(truth.plan->cost, 6);
  EXPECT_TRUE(finds_optimum(instance, truth.plan->cost));
}

TEST(SolveWithChoices, PolicyFixedRefusesTurningAgentsWithAChoice) {
  InstanceBuilder builder(Grid(3, 1, std::vector<bool>(3, true)));
  builder.add_agent({.id = "a",
                     .start = {.place = 0},
                     .goal = {},
                     .motion = {.turn_steps = 1},
                     .goals = std::vector<Place>{1, 2}});
  const Instance instance = std::move(builder).build();
  try {
    solve_by(Method::kAuto, false, instance, with_policy(Policy::kFixed), Limits());
    ADD_FAILURE() << "accepted";
  } catch (const InstanceError& error) {
    EXPECT_EQ(error.field(), "agents/0");
    EXPECT_STREQ(error.what(),
                 "agent 'a' has a choice and needs time to turn, which policy fixed does not "
                 "support; expected policy free, or an agent without a choice");
  }
}

TEST(SolveWithChoices, TooFewGoalsAreInfeasible) {
  InstanceBuilder builder(Grid(3, 1, std::vector<bool>(3, true)));
  for (const Place start : {0, 2})
    builder.add_agent({.id = "a" + std::to_string(start),
                       .start = {.place = start},
                       .goal = {},
                       .goals = std::vector<Place>{1}});
  const Instance instance = std::move(builder).build();
  for (const Policy policy : {Policy::kFree, Policy::kFixed}) {
    const Solution solution =
        solve_by(Method::kAuto, false, instance, with_policy(policy), Limits());
    EXPECT_EQ(solution.status, Status::kInfeasible);
    EXPECT_EQ(solution.stats.texts.at("reason"),
              "agents 'a0', 'a2' have only 1 goal ([1, 0]), but each must end on one of its own");
  }
}

// After its task on the dead end D the agent can end only there, on the goal of the other agent.
TEST(SolveWithChoices, NoWayFromATaskToAFreeGoalIsInfeasible) {
  enum : std::uint8_t { kA, kB, kD };
  InstanceBuilder builder(
      Roadmap({{"A", {0, 0}}, {"B", {1, 0}}, {"D", {2, 0}}}, {{kA, kB}, {kB, kD, 3, true}}));
  builder.add_agent(
      {.id = "a", .start = {.place = kB}, .goal = {}, .goals = std::vector<Place>{kA, kB, kD}});
  builder.add_agent("c", Place{kA}, Place{kD});
  builder.add_task("t", Place{kD}, std::vector<std::string>{"a"});
  const Instance instance = std::move(builder).build();
  const Solution solution = solve_by(Method::kAuto, false, instance, {}, Limits());
  EXPECT_EQ(solution.status, Status::kInfeasible);
  EXPECT_EQ(solution.lower_bound, 0);
}

// The engines themselves refuse choices, except for policy fixed, so no program can drop them.
TEST(SolveWithChoices, EnginesRefuseChoices) {
  EXPECT_THROW(solve(testing::instance_with_goals(), {}, Limits()), InstanceError);
  EXPECT_THROW(solve(testing::instance_with_need(), {}, Limits()), InstanceError);
}

}  // namespace choices_test
}  // namespace grove::detail
