// SPDX-License-Identifier: MIT
#include "model/limits.h"

#include <gtest/gtest.h>
#include <sys/mman.h>

#include <cstring>

#include "tests/support/clocks.h"

namespace grove::detail {
namespace limits_test {

TEST(Limits, NeverStopsWithoutALimit) {
  const Limits limits;
  EXPECT_FALSE(limits.stop_requested());
  EXPECT_TRUE(limits.memory_allows(std::size_t{1} << 60));
}

TEST(Limits, StopsAtTheDeadline) {
  Limits limits;
  limits.set_deadline(testing::kPast);
  EXPECT_TRUE(limits.stop_requested());
  EXPECT_EQ(limits.reason(), StopReason::kTime);
  EXPECT_LE(limits.seconds_left(), 0);
}

TEST(Limits, UsesTheGivenClock) {
  Limits limits;
  testing::ManualClock clock(limits);
  limits.set_deadline(limits.now() + std::chrono::seconds(3));
  const Limits part(limits, 2);
  clock.advance(std::chrono::milliseconds(1999));
  EXPECT_FALSE(part.stop_requested());
  EXPECT_NEAR(part.seconds_left(), 0.001, 1e-9);
  EXPECT_NEAR(limits.seconds_left(), 1.001, 1e-9);
  clock.advance(std::chrono::milliseconds(1));
  EXPECT_TRUE(part.stop_requested());
  EXPECT_FALSE(limits.stop_requested());
  clock.advance(std::chrono::seconds(1));
  EXPECT_TRUE(limits.stop_requested());
  EXPECT_EQ(limits.reason(), StopReason::kTime);
}

TEST(Limits, ReadsMemoryUseEveryFiveMilliseconds) {
  Limits limits;
  testing::ManualClock clock(limits);
  limits.set_memory_limit(std::size_t{1} << 60);
  EXPECT_FALSE(limits.stop_requested());
  EXPECT_GT(limits.last_resident(), 0u);
  limits.set_memory_limit(1);
  clock.advance(std::chrono::milliseconds(4));
  EXPECT_FALSE(limits.stop_requested());
  clock.advance(std::chrono::milliseconds(1));
  EXPECT_TRUE(limits.stop_requested());
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
  limits.set_deadline(testing::kPast);
  EXPECT_TRUE(limits.stop_requested());
  EXPECT_EQ(limits.reason(), StopReason::kInterrupt);
}

TEST(ResidentBytes, AreThoseOfTheRunningProcess) {
  const std::size_t now = resident_bytes();
  EXPECT_GT(now, std::size_t{100'000});
  EXPECT_GE(peak_resident_bytes() + (std::size_t{1} << 20), now);  // the kernel counts inexactly
}

TEST(ResidentBytes, CountOnlyAPartOfSharedMemory) {
  constexpr std::size_t kSize = std::size_t{64} << 20;
  void* const shared =
      ::mmap(nullptr, kSize, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  ASSERT_NE(shared, MAP_FAILED);
  std::memset(shared, 1, kSize);
  const std::size_t whole = resident_bytes();
  set_shared_memory_accounting(4, kSize);
  const std::size_t part = resident_bytes();
  set_shared_memory_accounting(4, 4 * kSize);  // only a quarter touched here
  const std::size_t part_of_more = resident_bytes();
  set_shared_memory_accounting(1, 0);
  EXPECT_GT(whole, kSize);
  EXPECT_LT(part + kSize / 4 * 3, whole + (std::size_t{1} << 20));
  EXPECT_GT(part, kSize / 4);
  EXPECT_GT(part_of_more, kSize);
  EXPECT_LT(part_of_more, part + kSize);
  EXPECT_GE(resident_bytes(), whole);
  ::munmap(shared, kSize);
}

}  // namespace limits_test
}  // namespace grove::detail
