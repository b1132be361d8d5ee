// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "lagrangian/pricing_queue.h"
#include "tests/fuzz/random.h"
#include "tests/lagrangian/tiny_agents.h"
#include "tests/oracle/joint_oracle.h"
#include "tests/support/fuzz_factor.h"

namespace grove::detail::lagrangian_test {
namespace {

// Returns parameters that lead to steps of all sizes, including sizes unsuitable for real runs.
Tuning wild_tuning(fuzz::Random& random) {
  Tuning tuning;
  tuning.lagrangian_level = random.pick<double>({0.01, 0.1, 1});
  tuning.lagrangian_patience = random.between(1, 10);
  tuning.lagrangian_shrink = random.pick<double>({0.5, 0.9, 0.99});
  tuning.lagrangian_smoothing = random.pick<double>({0, 0.5, 0.95});
  tuning.lagrangian_step_work = random.pick<std::int64_t>({1, 50, 4000});
  return tuning;
}

class LagrangianBoundTest : public ::testing::Test {
 protected:
  // Returns the bound after at most `rounds` rounds. After each round the bound must not exceed
  // `optimum`.
  static Cost bound_of(TinyProblem& known, const Tuning& tuning, int rounds, Cost optimum) {
    auto lagrangian = LagrangianBound::make(known.instance, known.stops, tuning);
    if (!lagrangian) return 0;
    PricingQueue bound(std::move(lagrangian), tuning);
    Pricer pricer(bound.multipliers(), known.stops);
    while (!bound.ended() && bound.rounds() < rounds) {
      auto job = bound.next();
      if (!job) {
        ADD_FAILURE() << "nothing to do";
        break;
      }
      bound.perform(*job, pricer, optimum + 5, 0, {});
      bound.commit(std::move(*job));
      if (bound.lower_bound() > optimum) {
        ADD_FAILURE() << bound.lower_bound() << " in round " << bound.rounds()
                      << ", but there is a plan of " << optimum;
        break;
      }
    }
    return bound.lower_bound();
  }
};

// The bound never exceeds the oracle's optimum, whatever the step sizes.
TEST_F(LagrangianBoundTest, IsNeverAboveTheOptimum) {
  int tried = 0, raised = 0;
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(testing::fuzz_rounds(400));
       ++seed) {
    SCOPED_TRACE(seed);
    Instance instance = tiny_instance(seed);
    if (seed % 5 == 0) instance = instance.without_following();
    const oracle::Answer truth = oracle::solve_jointly(instance);
    if (!truth.plan) continue;
    TinyProblem known(instance);
    fuzz::Random random(seed);
    const Cost first = bound_of(known, Tuning(), 1, truth.plan->cost);
    const Cost last = bound_of(known, wild_tuning(random), 60, truth.plan->cost);
    ++tried;
    raised += last > first;
    if (HasFailure()) return;
  }
  EXPECT_GT(tried, 200);
  EXPECT_GT(raised, 40);
}

// Two agents that must pass each other in a corridor with one bay: the multipliers raise the bound.
TEST_F(LagrangianBoundTest, RisesForAgentsThatMustPassEachOther) {
  TinyProblem known(corridor());
  const oracle::Answer truth = oracle::solve_jointly(known.instance);
  ASSERT_TRUE(truth.plan);
  EXPECT_GE(bound_of(known, Tuning(), 300, truth.plan->cost), 9);
}

// A new dual solution comes from a round with the best bound, and its values add up to that bound.
// It becomes visible only with commit().
TEST_F(LagrangianBoundTest, HasTheDualSolutionOfItsBestRounds) {
  TinyProblem known(corridor());
  Tuning tuning;
  tuning.first_dual_solution_round = 3;
  PricingQueue bound(LagrangianBound::make(known.instance, known.stops, tuning), tuning);
  Pricer pricer(bound.multipliers(), known.stops);
  std::shared_ptr<const DualSolution> last;
  int solutions = 0;
  while (!bound.ended() && bound.rounds() < 100) {
    auto job = bound.next();
    ASSERT_TRUE(job);
    const Cost proven = bound.lower_bound();
    bound.perform(*job, pricer, 20, 0, {});
    EXPECT_EQ(bound.dual_solution(), last);
    bound.commit(std::move(*job));
    const auto solution = bound.dual_solution();
    if (solution == last) continue;
    last = solution;
    ++solutions;
    EXPECT_GE(bound.rounds(), 3);
    ScaledCost sum = -solution->multipliers.sum();
    for (AgentIndex agent = 0; agent < known.instance.agent_count(); ++agent) {
      sum += solution->values[agent];
      EXPECT_EQ(solution->multipliers.price(agent, solution->paths[agent]),
                solution->values[agent]);
    }
    EXPECT_EQ((sum + Penalties::kUnit - 1) / Penalties::kUnit, proven);
  }
  EXPECT_GT(solutions, 3);
  EXPECT_LT(solutions, 30);
}

}  // namespace
}  // namespace grove::detail::lagrangian_test
