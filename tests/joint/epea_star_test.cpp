// SPDX-License-Identifier: MIT
#include "joint/epea_star.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <optional>

#include "model/check.h"
#include "model/omega.h"
#include "tests/fuzz/random_instance.h"
#include "tests/fuzz/random_puzzle.h"
#include "tests/oracle/joint_oracle.h"
#include "tests/support/fuzz_factor.h"

namespace grove::detail {
namespace epea_star_test {

constexpr std::size_t kMaxBytes = std::size_t{1} << 28;

std::unique_ptr<EpeaStar> search_of(const Instance& instance) {
  return EpeaStar::make(instance, 64, kMaxBytes);
}

// Expands 7 states per call. The bound rises to the oracle's optimum and never exceeds it.
TEST(EpeaStar, AgreesWithTheOracle) {
  int solved = 0, infeasible = 0;
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(testing::fuzz_rounds(300));
       ++seed) {
    SCOPED_TRACE(seed);
    Instance instance = fuzz::any_instance(seed).build();
    if (seed % 5 == 0) instance = instance.without_following();
    const oracle::Answer truth = oracle::solve_jointly(instance);
    if (truth.verdict == oracle::Verdict::kTooLarge) continue;
    const auto search = search_of(instance);
    ASSERT_TRUE(search);
    const Cost optimum = truth.plan ? truth.plan->cost : kInfiniteCost;
    EpeaStar::Outcome outcome = EpeaStar::Outcome::kWorking;
    while (outcome == EpeaStar::Outcome::kWorking) {
      outcome = search->run(7, kInfiniteCost, {});
      ASSERT_LE(search->lower_bound(), optimum);
    }
    ASSERT_EQ(outcome, EpeaStar::Outcome::kEnded);
    ASSERT_EQ(search->plan().has_value(), truth.plan.has_value());
    ASSERT_EQ(search->lower_bound(), optimum);
    ++(truth.plan ? solved : infeasible);
    if (!truth.plan) continue;
    Solution solution;
    solution.status = Status::kOptimal;
    solution.plan = search->plan();
    solution.lower_bound = optimum;
    ASSERT_TRUE(check(instance, solution).empty());
  }
  EXPECT_GT(solved, 100);
  EXPECT_GT(infeasible, 5);
}

// With a cutoff equal to the optimum the search finds no plan; with a cutoff of optimum + 1 it
// finds the optimum.
TEST(EpeaStar, ProvesTheCutoff) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    SCOPED_TRACE(seed);
    const Instance instance = fuzz::any_instance(seed).build();
    const oracle::Answer truth = oracle::solve_jointly(instance);
    if (!truth.plan) continue;
    const auto at = search_of(instance);
    while (at->run(100, truth.plan->cost, {}) == EpeaStar::Outcome::kWorking) {
    }
    EXPECT_FALSE(at->plan());
    EXPECT_GE(at->lower_bound(), truth.plan->cost);
    const auto above = search_of(instance);
    while (above->run(100, truth.plan->cost + 1, {}) == EpeaStar::Outcome::kWorking) {
    }
    ASSERT_TRUE(above->plan());
    EXPECT_EQ(above->plan()->cost, truth.plan->cost);
  }
}

TEST(EpeaStar, EndsAsTooLargeWithoutMemory) {
  const Instance instance = fuzz::random_puzzle(94).build();
  const auto search = EpeaStar::make(instance, 64, 1);
  ASSERT_TRUE(search);
  auto outcome = EpeaStar::Outcome::kWorking;
  while (outcome == EpeaStar::Outcome::kWorking) outcome = search->run(1000, kInfiniteCost, {});
  EXPECT_EQ(outcome, EpeaStar::Outcome::kTooLarge);
  EXPECT_FALSE(search->plan());
}

TEST(EpeaStar, RefusesTooManyJointStates) {
  const Instance instance = fuzz::random_puzzle(39).build();
  EXPECT_FALSE(EpeaStar::make(instance, 20, kMaxBytes));
  EXPECT_TRUE(EpeaStar::make(instance, 40, kMaxBytes));
}

// The search runs long enough to build larger pattern databases on the way. kOptimum comes from a
// search without them.
TEST(EpeaStar, ContinuesWithLargerPatternDatabases) {
  constexpr Cost kOptimum = 78;
  const Instance instance = fuzz::random_puzzle(94).build();
  const auto search = search_of(instance);
  while (search->run(1000, kInfiniteCost, {}) == EpeaStar::Outcome::kWorking)
    ASSERT_LE(search->lower_bound(), kOptimum);
  ASSERT_TRUE(search->plan());
  EXPECT_EQ(search->plan()->cost, kOptimum);
  EXPECT_EQ(search->lower_bound(), kOptimum);
}

}  // namespace epea_star_test
}  // namespace grove::detail
