// SPDX-License-Identifier: MIT
// Tests the protocol under random delays, slow ranks and unresponsive ranks against the optimum:
// the bound is valid after every step, and the answer makes no false claim.
#include <gtest/gtest.h>

#include "tests/mpi/try_schedule.h"

namespace grove::detail {
namespace schedule_test {

using testing::ScheduleTally;
using testing::try_schedule;

TEST(RandomSchedules, NeverMakeFalseClaims) {
  ScheduleTally tally;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const auto false_claims = try_schedule(seed, tally);
    EXPECT_TRUE(false_claims.empty()) << "seed " << seed << ": " << false_claims.front();
  }
  EXPECT_GT(tally.tried, 35);
  EXPECT_GT(tally.batches, 40) << "too few nodes were sent to test anything";
  EXPECT_GT(tally.learned_bounds, 60) << "too few bounds were sent to test anything";
  EXPECT_GT(tally.remote_pricings, 12) << "too little was priced remotely to test anything";
}

}  // namespace schedule_test
}  // namespace grove::detail
