// SPDX-License-Identifier: MIT
#include "primal/round_progress.h"

#include <gtest/gtest.h>

namespace grove::detail {
namespace round_progress_test {

// The round takes an effort of 500 to its best plan, which LNS finds in iteration 10.
RoundProgress progress() {
  RoundProgress progress;
  progress.begin_round(1000);
  progress.note_gain(1200, 4);
  progress.note_gain(1500, 10);
  return progress;
}

TEST(RoundProgress, StallsAfterTheSameEffortWithoutGain) {
  EXPECT_FALSE(progress().has_stalled(1999, 10'000, 1));
  EXPECT_TRUE(progress().has_stalled(2000, 10'000, 1));
}

TEST(RoundProgress, StallsOnlyAfterManyIterations) {
  EXPECT_FALSE(progress().has_stalled(100'000, 10 + 199, 20));
  EXPECT_TRUE(progress().has_stalled(100'000, 10 + 200, 20));
  EXPECT_FALSE(progress().has_stalled(100'000, 10 + 299, 30));
  EXPECT_TRUE(progress().has_stalled(100'000, 10 + 300, 30));
}

TEST(RoundProgress, RefusesFallingEffort) {
  RoundProgress round = progress();
  EXPECT_THROW(round.begin_round(1499), AssertionFailed);
  EXPECT_THROW(round.note_gain(1499, 11), AssertionFailed);
  EXPECT_THROW(round.note_gain(1501, 9), AssertionFailed);
  round.begin_round(3000);
  EXPECT_THROW(round.has_stalled(4000, 10'000, 1), AssertionFailed);
}

}  // namespace round_progress_test
}  // namespace grove::detail
