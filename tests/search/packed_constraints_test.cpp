// SPDX-License-Identifier: MIT
#include "grove/detail/search/packed_constraints.h"

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <random>

#include "grove/detail/search/situations.h"

namespace grove::detail {
namespace packed_constraints_test {

std::string packed(std::span<const Constraint> constraints) {
  std::string bytes;
  pack(constraints, bytes);
  return bytes;
}

// Near the last one, or anything at all.
std::int32_t number(std::mt19937& random, std::int32_t often) {
  constexpr auto kLimits = std::numeric_limits<std::int32_t>();
  switch (random() % 8) {
    case 0:
      return often;
    case 1:
      return kLimits.min() + static_cast<std::int32_t>(random() % 3);
    case 2:
      return kLimits.max() - static_cast<std::int32_t>(random() % 3);
    case 3:
      return static_cast<std::int32_t>(random());
    default:
      return static_cast<std::int32_t>(random() % 300);
  }
}

TEST(PackedConstraints, AreAnyConstraints) {
  std::mt19937 random(5);
  std::map<std::string, std::vector<Constraint>> all;
  for (int round = 0; round < 20'000; ++round) {
    std::vector<Constraint> constraints(random() % 4);
    for (Constraint& c : constraints)
      c = {number(random, kNoCell), number(random, kNoCell), number(random, 0),
           number(random, kNever), static_cast<ConstraintKind>(random() % kConstraintKinds)};
    const auto [entry, is_new] = all.emplace(packed(constraints), constraints);
    EXPECT_EQ(entry->second, constraints);
    EXPECT_EQ(unpacked_constraints(entry->first), constraints);
  }
}

TEST(PackedConstraints, AreAppendedToWhatIsThere) {
  const std::vector<Constraint> constraints(1, Constraint{.cell = 7, .begin = 2, .end = kNever});
  std::string bytes = "x";
  pack(constraints, bytes);
  EXPECT_EQ(bytes, "x" + packed(constraints));
}

TEST(PackedConstraints, AreShortInCanonicalOrder) {
  std::mt19937 random(6);
  std::vector<Constraint> constraints(20);
  for (Constraint& c : constraints) {
    c.cell = static_cast<Cell>(random() % 1024);
    if (random() % 2 == 0) c.from = c.cell + 32;
    c.begin = static_cast<Time>(random() % 60);
    c.end = c.begin + static_cast<Time>(random() % 10);
  }
  canonical(constraints);
  EXPECT_LE(packed(constraints).size(), 6 * constraints.size());
}

}  // namespace packed_constraints_test
}  // namespace grove::detail
