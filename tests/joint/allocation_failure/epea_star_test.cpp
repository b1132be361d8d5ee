// SPDX-License-Identifier: MIT
// Joint search with an allocation failure at many different points: the search ends and its bound
// is valid.
#include "joint/epea_star.h"

#include <gtest/gtest.h>

#include "tests/fuzz/random_puzzle.h"
#include "tests/support/failing_new.h"

namespace grove::detail {
namespace epea_star_memory_test {

constexpr std::size_t kMaxBytes = std::size_t{1} << 28;

struct End {
  EpeaStar::Outcome outcome = EpeaStar::Outcome::kTooLarge;
  Cost lower_bound = 0;
};

End run_to_the_end(const Instance& instance) {
  const auto search = EpeaStar::make(instance, 64, kMaxBytes);
  if (!search) return {};
  End end{EpeaStar::Outcome::kWorking};
  while (end.outcome == EpeaStar::Outcome::kWorking)
    end.outcome = search->run(100, kInfiniteCost, {});
  end.lower_bound = search->plan() || end.outcome == EpeaStar::Outcome::kTooLarge
                        ? search->lower_bound()
                        : kInfiniteCost;
  return end;
}

TEST(EpeaStarWithoutMemory, EndsAndKeepsItsBound) {
  const Instance instance = fuzz::random_puzzle(3).build();
  const Cost optimum = run_to_the_end(instance).lower_bound;
  int failures = 0;
  for (int at = 0;; at += 1 + at / 12, ++failures) {
    testing::allocations_until_failure = at;
    const End end = run_to_the_end(instance);
    testing::allocations_until_failure = -1;
    ASSERT_LE(end.lower_bound, optimum) << "failure " << at;
    if (end.outcome == EpeaStar::Outcome::kEnded) break;
  }
  EXPECT_GT(failures, 20);
}

}  // namespace epea_star_memory_test
}  // namespace grove::detail
