// SPDX-License-Identifier: MIT
#include "mpi/polling.h"

#include <gtest/gtest.h>

#include <vector>

namespace grove::detail {
namespace polling_test {

TEST(Polling, BacksOffExponentially) {
  std::vector<double> polls;
  for (double time = 100; polls.size() < 8; time = polls.back() + 1e-9)
    polls.push_back(next_poll(100, time, 16));
  const std::vector<double> expected{101, 102, 104, 108, 116, 132, 148, 164};
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(polls[i], expected[i], 1e-6);
}

TEST(Polling, NextPollIsWithinTheMaxInterval) {
  for (double elapsed = 0; elapsed < 100; elapsed += 0.37) {
    const double poll = next_poll(7, 7 + elapsed, 16);
    EXPECT_GE(poll, 7 + elapsed);
    EXPECT_LE(poll, 7 + elapsed + 16);
  }
  EXPECT_EQ(next_poll(3, 9, 0), 9) << "without back-off";
}

TEST(Polling, IsFrequentAfterTheSearchHasEnded) {
  EXPECT_EQ(max_poll_interval(false, 16), 16);
  for (double elapsed = 0; elapsed < 100; elapsed += 0.37)
    EXPECT_LE(next_poll(0, elapsed, max_poll_interval(true, 16)), elapsed + 1 + 1e-9);
}

TEST(ReportInterval, GrowsWithTheRunUpToALimit) {
  EXPECT_EQ(pause_at(0, 2e-3), 2e-3);
  EXPECT_EQ(pause_at(0.1, 2e-3), 2e-3);
  EXPECT_EQ(pause_at(1, 2e-3), 0.01);
  EXPECT_EQ(pause_at(1e6, 2e-3), kMaxPause_s);
  EXPECT_EQ(pause_at(1e6, 0.1), 0.1)
      << "a longer base interval, for coordinators with many children";
}

}  // namespace polling_test
}  // namespace grove::detail
