// SPDX-License-Identifier: MIT
#include "search/packed_constraints.h"

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <random>
#include <string_view>

#include "search/subproblem_table.h"

namespace grove::detail {
namespace packed_constraints_test {

std::string packed(std::span<const Constraint> constraints) {
  return PackedConstraints(constraints).bytes;
}

// Decodes the list from its bytes, which proves that no other list has the same bytes.
class Unpacker {
 public:
  explicit Unpacker(std::string_view bytes) : bytes_(bytes) {}

  std::vector<Constraint> all() {
    std::vector<Constraint> constraints;
    Constraint c{.cell = 0};
    while (!bytes_.empty()) {
      const std::uint64_t first = number();
      c.kind = static_cast<ConstraintKind>(first % 8);
      c.cell = near(c.cell, first / 8);
      c.from = near_or(c.cell, kNoCell);
      c.begin = near(c.begin, number());
      c.end = near_or(c.begin, kNever);
      constraints.push_back(c);
    }
    return constraints;
  }

 private:
  std::uint64_t number() {
    const auto byte = static_cast<unsigned char>(bytes_.at(0));
    bytes_.remove_prefix(1);
    return byte < 0x80 ? byte : byte - 0x80 + 0x80 * number();
  }
  static std::int32_t near(std::int32_t value, std::uint64_t number) {
    const auto half = static_cast<std::int64_t>(number / 2);
    return static_cast<std::int32_t>(value + (number % 2 == 0 ? half : -half - 1));
  }
  std::int32_t near_or(std::int32_t value, std::int32_t far) {
    const std::uint64_t number = this->number();
    return number == 0 ? far : near(value, number - 1);
  }

  std::string_view bytes_;
};

// Returns `often` with probability 1/8, otherwise a small, an extreme or an arbitrary number.
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

TEST(PackedConstraints, EncodeAnyConstraintsUniquely) {
  std::mt19937 random(5);
  std::map<std::string, std::vector<Constraint>> all;
  for (int round = 0; round < 20'000; ++round) {
    std::vector<Constraint> constraints(random() % 4);
    for (Constraint& c : constraints)
      c = {number(random, kNoCell), number(random, kNoCell), number(random, 0),
           number(random, kNever), static_cast<ConstraintKind>(random() % kConstraintKinds)};
    const auto [entry, is_new] = all.emplace(packed(constraints), constraints);
    EXPECT_EQ(entry->second, constraints);
    EXPECT_EQ(Unpacker(entry->first).all(), constraints);
  }
}

TEST(PackedConstraints, AreAppended) {
  const std::vector<Constraint> constraints(1, Constraint{.cell = 7, .begin = 2, .end = kNever});
  std::string bytes = "x";
  pack(constraints, bytes);
  EXPECT_EQ(bytes, "x" + packed(constraints));
}

TEST(PackedConstraints, TakeAtMostSixBytesEachInCanonicalOrder) {
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
