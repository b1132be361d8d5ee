// SPDX-License-Identifier: MIT
// Tiny random instances of all kinds with choices, and their optima.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "model/check.h"
#include "model/instance.h"
#include "model/plan.h"
#include "tests/fuzz/random_instance.h"
#include "tests/oracle/joint_oracle.h"
#include "tests/support/fuzz_factor.h"
#include "tests/support/random_choices.h"

namespace grove::detail {
namespace assignment_test {

inline constexpr std::size_t kStates = 200'000;  // of the oracle

// Calls test(instance, truth) for random instances with choices that the oracle can solve.
template <class Test>
void for_each_instance(int rounds, Test test) {
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(testing::fuzz_rounds(rounds));
       ++seed) {
    SCOPED_TRACE(seed);
    const Instance instance = with_random_choices(fuzz::any_instance(seed).build(), seed);
    if (!instance.has_choices()) continue;
    const oracle::Answer truth = oracle::solve_jointly(instance, kStates);
    if (truth.verdict != oracle::Verdict::kTooLarge) test(instance, truth);
  }
}

// The violations of a plan; empty if it is valid.
inline std::string verdict(const Instance& instance, const Plan& plan) {
  Solution solution;
  solution.plan = plan;
  solution.status = Status::kFeasible;
  solution.omega = Omega::infinite();
  solution.lower_bound = 0;
  if (plan.cost == 0) solution.status = Status::kOptimal;
  std::string text;
  for (const Violation& violation : check(instance, solution, 3))
    text += violation.json_pointer + ": " + violation.message + "\n";
  return text;
}

}  // namespace assignment_test
}  // namespace grove::detail
