// SPDX-License-Identifier: MIT
#include "model/omega.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace grove::detail {
namespace omega_test {

TEST(Omega, ZeroAcceptsOnlyTheBoundItself) {
  const Omega omega;
  EXPECT_TRUE(omega.accepts(100, 100));
  EXPECT_FALSE(omega.accepts(101, 100));
}

TEST(Omega, IsExactWhereDoublesMayRound) {
  // Costs at or above the threshold (1 + omega) * bound. In double precision the product can round
  // to a value below an integer: 1.15 * 100 is 114.99999999999999.
  EXPECT_TRUE(Omega::parse("0.15").accepts(115, 100));
  EXPECT_TRUE(Omega::parse("0.1").accepts(11, 10));
  EXPECT_TRUE(Omega::parse("0.1").accepts(33, 30));
  EXPECT_FALSE(Omega::parse("0.1").accepts(34, 30));
  EXPECT_TRUE(Omega::parse("0.01").accepts(101, 100));
  EXPECT_FALSE(Omega::parse("0.01").accepts(101, 99));
  EXPECT_TRUE(Omega::parse("0.07").accepts(107, 100));  // 1.07 * 100 is exact only by chance
}

TEST(Omega, InfinityAcceptsEverything) {
  EXPECT_TRUE(Omega::parse("inf").is_infinite());
  EXPECT_TRUE(Omega::infinite().accepts(kInfiniteCost, 0));
}

TEST(Omega, DoesNotOverflow) {
  EXPECT_TRUE(Omega::parse("1e6").accepts(kInfiniteCost, kInfiniteCost));
}

TEST(Omega, ReadsAndPrintsTheSameNumber) {
  for (const char* text : {"0", "0.01", "0.1", "1", "inf", "0.000000001", "2.5"})
    EXPECT_EQ(Omega::parse(text).to_string() == text ||
                  Omega::parse(Omega::parse(text).to_string()) == Omega::parse(text),
              true)
        << text;
}

TEST(Omega, RefusesUnrepresentableNumbers) {
  for (const char* text : {"", "-0.1", "nan", "1e7", "0.01x", "0.0000000001", "1e-12",
                           "999999.9999999999", "123456.1234567891", "infinity", "1,5"})
    EXPECT_THROW(Omega::parse(text), std::invalid_argument) << text;
}

}  // namespace omega_test
}  // namespace grove::detail
