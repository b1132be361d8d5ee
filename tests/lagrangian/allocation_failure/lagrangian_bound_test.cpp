// SPDX-License-Identifier: MIT
// Allocation failures during the rounds of the Lagrangian bound: the computation ends, and its
// bound is valid.
#include "lagrangian/pricing_queue.h"

#include <gtest/gtest.h>

#include "tests/lagrangian/tiny_agents.h"
#include "tests/support/failing_new.h"

namespace grove::detail::lagrangian_test {
namespace {

constexpr int kRounds = 12;

struct End {
  Cost lower_bound = 0;
  bool failed = false;
};

// Runs the bound with one allocation failure. `refuse_at`: index of the failing allocation within
// the jobs, from 0; negative: none.
End run(TinyProblem& known, int refuse_at) {
  const Tuning tuning;
  PricingQueue queue(LagrangianBound::make(known.instance, known.stops, tuning), tuning);
  Pricer pricer(queue.multipliers(), known.stops);
  End end;
  while (!queue.ended() && queue.rounds() < kRounds) {
    auto job = queue.next();
    if (!job) break;
    testing::allocations_until_failure = refuse_at;
    queue.perform(*job, pricer, 20, 0, {});
    refuse_at = testing::allocations_until_failure;
    testing::allocations_until_failure = -1;
    end.failed = end.failed || job->failed;
    queue.commit(std::move(*job));
  }
  end.lower_bound = queue.lower_bound();
  return end;
}

TEST(LagrangianBoundWithoutMemory, EndsAndKeepsItsBound) {
  TinyProblem known(corridor());
  const Cost whole = run(known, -1).lower_bound;
  int failures = 0;
  for (int at = 0;; at += 1 + at / 20, ++failures) {
    const End end = run(known, at);
    ASSERT_LE(end.lower_bound, whole) << "failure " << at;
    if (!end.failed) break;
  }
  EXPECT_GT(failures, 8);
}

}  // namespace
}  // namespace grove::detail::lagrangian_test
