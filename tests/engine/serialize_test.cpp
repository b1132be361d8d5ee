// SPDX-License-Identifier: MIT
#include "engine/serialize.h"

#include <gtest/gtest.h>

#include <random>

namespace grove::detail {
namespace serialize_test {

NodeRecord a_node() {
  NodeRecord record;
  record.constraints = {{3, {17, kNoCell, 4, kNever, ConstraintKind::kVertexOrEdge}},
                        {0, {17, 16, 4, 4, ConstraintKind::kNoTraversal}},
                        {1, {5, kNoCell, 2, 0, ConstraintKind::kNoRestBy}}};
  record.paths = {{1, 25, {0x0123456789ABCDEF, 7}}, {4, 0, {}}};
  record.cost = 612;
  record.bound = 613;
  record.conflicts = 9;
  record.bounded = true;
  return record;
}

TreeRecord a_tree() {
  TreeRecord record;
  record.orders = {{{{2, 0, 1}, 0}, true, 30, {1, 2}}, {{{}, ~StopSet{0}}, false, 0, {}}};
  return record;
}

Plan a_plan() {
  return {70, {{40, {2, 0}, {5, 6, 7, 7}}, {30, {}, {9}}}};
}

bool same(const AgentPlan& a, const AgentPlan& b) {
  return a.cost == b.cost && a.sequence == b.sequence && a.path == b.path;
}

// Returns the message of the refusal, or "" if the bytes are accepted.
template <class T>
std::string refusal(std::string_view bytes) {
  try {
    from_bytes<T>(bytes);
    return "";
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
}

template <class T>
bool is_refused(std::string_view bytes) {
  return !refusal<T>(bytes).empty();
}

TEST(Bytes, RestoreTheValue) {
  EXPECT_EQ(from_bytes<NodeRecord>(to_bytes(a_node())), a_node());
  EXPECT_EQ(from_bytes<NodeRecord>(to_bytes(NodeRecord())), NodeRecord());
  EXPECT_EQ(from_bytes<TreeRecord>(to_bytes(a_tree())), a_tree());
  const Plan plan = from_bytes<Plan>(to_bytes(a_plan()));
  EXPECT_EQ(plan.cost, 70);
  EXPECT_TRUE(std::ranges::equal(plan.agents, a_plan().agents, same));
  using Counts = std::map<std::string, std::optional<std::int64_t>>;
  const Counts counts{{"nodes", 5}, {"", -1}, {"none", std::nullopt}};
  EXPECT_EQ(from_bytes<Counts>(to_bytes(counts)), counts);
}

// The byte order is part of the format and independent of the machine.
TEST(Bytes, HaveAFixedByteOrder) {
  EXPECT_EQ(to_bytes(std::uint32_t{300}), "\xAC\2");
  EXPECT_EQ(to_bytes(1.0), std::string("\0\0\0\0\0\0\xF0\x3F", 8));
  const std::vector<std::uint32_t> array{0x01020304};
  EXPECT_EQ(to_bytes(array), "\1\4\3\2\1");
}

TEST(Bytes, KeepNumbersOfAllSizes) {
  const auto same = [](auto value) {
    return from_bytes<decltype(value)>(to_bytes(value)) == value;
  };
  for (int bit = 0; bit < 64; ++bit)
    for (const int more : {-1, 0, 1}) {
      const std::uint64_t number = (std::uint64_t{1} << bit) + static_cast<std::uint64_t>(more);
      EXPECT_TRUE(same(number)) << number;
      EXPECT_TRUE(same(static_cast<std::int64_t>(number))) << number;
      EXPECT_TRUE(same(static_cast<std::int32_t>(number))) << number;
      EXPECT_TRUE(same(static_cast<std::uint16_t>(number))) << number;
      EXPECT_TRUE(same(static_cast<std::int8_t>(number))) << number;
    }
  EXPECT_EQ(to_bytes(std::int64_t{-64}).size(), 1) << "small ones are short";
}

TEST(Bytes, AreRefusedIfANumberOverflowsOrIsNotShortest) {
  EXPECT_EQ(refusal<std::uint16_t>(to_bytes(std::uint32_t{1} << 16)),
            "found a number with too many bits");
  EXPECT_EQ(refusal<std::int16_t>(to_bytes(std::int32_t{-32769})),
            "found a number with too many bits");
  EXPECT_EQ(refusal<std::int32_t>(to_bytes(std::int64_t{1} << 31)),
            "found a number with too many bits");
  EXPECT_EQ(refusal<std::uint64_t>(std::string(9, '\xFF') + '\2'),
            "found a number with too many bits");
  EXPECT_EQ(refusal<std::uint64_t>(std::string(10, '\xFF') + '\1'),
            "found a number with too many bits");
  EXPECT_EQ(refusal<std::uint64_t>(std::string("\x85\0", 2)),
            "found a number that is longer than necessary");
}

template <class T>
void expect_every_truncation_refused(const T& value) {
  const std::string bytes = to_bytes(value);
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_TRUE(is_refused<T>(std::string(bytes, 0, size))) << size;
  EXPECT_TRUE(is_refused<T>(bytes + '\0'));
}

TEST(Bytes, AreRefusedIfTruncatedOrTooLong) {
  expect_every_truncation_refused(a_node());
  expect_every_truncation_refused(a_tree());
  expect_every_truncation_refused(a_plan());
}

// Every bit flip is either refused or yields a different value.
template <class T>
void expect_every_bit_flip_detected(const T& value) {
  const std::string bytes = to_bytes(value);
  int refused = 0;
  for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    std::string damaged = bytes;
    damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ 1 << bit % 8);
    if (is_refused<T>(damaged))
      ++refused;
    else
      EXPECT_NE(to_bytes(from_bytes<T>(damaged)), bytes) << bit;
  }
  EXPECT_GT(refused, 40);
}

TEST(Bytes, DifferOrAreRefusedIfABitIsFlipped) {
  expect_every_bit_flip_detected(a_node());
  expect_every_bit_flip_detected(a_tree());
  expect_every_bit_flip_detected(a_plan());
}

TEST(Bytes, AreReadSafelyIfRandom) {
  std::mt19937 random(7);
  for (int i = 0; i < 20'000; ++i) {
    std::string noise(random() % 200, '\0');
    for (char& c : noise) c = static_cast<char>(random() % 4 == 0 ? random() : 0);
    is_refused<NodeRecord>(noise);
    is_refused<TreeRecord>(noise);
    is_refused<Plan>(noise);
  }
}

// A count above the number of bytes left is refused before memory for the items is allocated.
TEST(Bytes, AreRefusedIfACountExceedsTheBytesLeft) {
  const std::string message = "found a number of items above the number of bytes left";
  const std::string bytes = to_bytes(a_node());
  for (const std::uint64_t count : {std::uint64_t{bytes.size()}, std::uint64_t{1} << 31,
                                    std::uint64_t{1} << 61, ~std::uint64_t{0}}) {
    const std::string announced = to_bytes(count);
    std::string hostile = bytes;
    hostile.replace(1, 1, announced);  // the number of constraints, after the tree
    EXPECT_EQ(refusal<NodeRecord>(hostile), message) << count;
    EXPECT_EQ(refusal<std::vector<std::uint64_t>>(announced + std::string(9, 'x')), message);
    EXPECT_EQ(refusal<std::string>(announced + "xy"), message);
    using Map = std::map<std::string, std::string>;
    EXPECT_EQ(refusal<Map>(announced + "xy"), message);
  }
}

TEST(Bytes, AreRefusedIfNoBoolOrConstraintKind) {
  EXPECT_TRUE(is_refused<bool>("\2"));
  Constraint constraint;
  std::string bytes = to_bytes(constraint);
  // Nodes in earlier versions could have constraints on the sequence.
  for (const auto kind : {ConstraintKind::kStopIs, ConstraintKind::kStopIsNot}) {
    bytes.back() = static_cast<char>(kind);
    EXPECT_TRUE(is_refused<Constraint>(bytes));
  }
  bytes.back() = static_cast<char>(kConstraintKinds);
  EXPECT_TRUE(is_refused<Constraint>(bytes));
}

}  // namespace serialize_test
}  // namespace grove::detail
