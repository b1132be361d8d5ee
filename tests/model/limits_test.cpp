// SPDX-License-Identifier: MIT
#include "grove/detail/model/limits.h"

#include <gtest/gtest.h>

namespace grove::detail {
namespace limits_test {

TEST(Limits, NeverStopsWithoutALimit) {
  const Limits limits;
  EXPECT_FALSE(limits.stop_requested());
  EXPECT_TRUE(limits.memory_allows(std::size_t{1} << 60));
}

TEST(Limits, StopsAtTheDeadline) {
  Limits limits;
  limits.set_deadline(Limits::Clock::now());
  EXPECT_TRUE(limits.stop_requested());
  EXPECT_EQ(limits.reason(), StopReason::kTime);
  EXPECT_LE(limits.seconds_left(), 0);
}

TEST(Limits, StopsWhenMemoryIsUsedUp) {
  Limits limits;
  limits.set_memory_limit(1);
  EXPECT_FALSE(limits.memory_allows(1));
  EXPECT_TRUE(limits.stop_requested());
  EXPECT_EQ(limits.reason(), StopReason::kMemory);
}

TEST(Limits, StopsOnInterruptAndKeepsTheFirstReason) {
  std::atomic<bool> interrupted{true};
  Limits limits;
  limits.watch_interrupt(&interrupted);
  EXPECT_TRUE(limits.stop_requested());
  limits.set_deadline(Limits::Clock::now());
  EXPECT_TRUE(limits.stop_requested());
  EXPECT_EQ(limits.reason(), StopReason::kInterrupt);
}

TEST(ResidentBytes, AreThoseOfARunningProcess) {
  const std::size_t now = resident_bytes();
  EXPECT_GT(now, std::size_t{100'000});
  EXPECT_GE(peak_resident_bytes() + (std::size_t{1} << 20), now);  // the kernel counts by threads
}

}  // namespace limits_test
}  // namespace grove::detail
