// SPDX-License-Identifier: MIT
// The protocol under random delays, slow ranks and ranks that stand still, against exhaustive
// search: the bound holds after every step, and the answer is the optimum.
#include <gtest/gtest.h>

#include "tests/mpi/try_schedule.h"

namespace grove::detail {
namespace schedule_test {

using testing::ScheduleTally;
using testing::try_schedule;

TEST(Schedules, NeverSayMoreThanIsTrue) {
  ScheduleTally tally;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const auto false_claims = try_schedule(seed, tally);
    EXPECT_TRUE(false_claims.empty()) << "seed " << seed << ": " << false_claims.front();
  }
  EXPECT_GT(tally.tried, 35);
  EXPECT_GT(tally.batches, 40) << "too few nodes travelled to be a test";
  EXPECT_GT(tally.facts, 60) << "too few facts were told to be a test";
  EXPECT_GT(tally.prices, 12) << "too few prices were asked for to be a test";
}

}  // namespace schedule_test
}  // namespace grove::detail
