// SPDX-License-Identifier: MIT
#include "model/random.h"

#include <gtest/gtest.h>

namespace grove::detail {
namespace random_test {

TEST(Random, DrawsTheSameEverywhere) {
  const auto eight = [](Random random) {
    std::vector<int> draws;
    for (int k = 0; k < 8; ++k) draws.push_back(random.below(10));
    return draws;
  };
  EXPECT_EQ(eight(Random(42)), (std::vector<int>{6, 4, 0, 2, 1, 8, 6, 4}));
  EXPECT_EQ(eight(Random(42, 1)), (std::vector<int>{9, 1, 1, 5, 3, 6, 7, 7}));
  EXPECT_NE(eight(Random(42, 2)), eight(Random(42, 1)));
}

TEST(Random, DrawsEachNumberAboutEquallyOften) {
  Random random(7, 3);
  std::vector<int> counts(3);
  for (int k = 0; k < 30'000; ++k) ++counts[random.below(3)];
  for (int count : counts) EXPECT_NEAR(count, 10'000, 400);
}

// The bound is three quarters of the 2^64 draws. Without rejection the draws in the fourth quarter
// would map to the lowest third again, so that half of the results would lie in that third.
TEST(Random, RejectsDrawsThatWouldFavorTheLowestNumbers) {
  constexpr std::uint64_t kBound = std::uint64_t{3} << 62;
  Random random(1);
  int low = 0;
  for (int k = 0; k < 3'000; ++k) low += static_cast<int>(random.below(kBound) < kBound / 3);
  EXPECT_NEAR(low, 1'000, 120);
}

}  // namespace random_test
}  // namespace grove::detail
