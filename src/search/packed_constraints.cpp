// SPDX-License-Identifier: MIT
// Four numbers for each constraint, of 7 bits to a byte, the last of which has its high bit clear:
// kind and cell, place of departure, begin, end. Each can be told from those before, so what
// unpack() returns depends on all of the bytes: different lists cannot have the same ones.
#include "grove/detail/search/packed_constraints.h"

#include <cstdint>

#include "grove/detail/model/assert.h"

namespace grove::detail {
namespace {

constexpr std::uint64_t kKinds = 8;
static_assert(kConstraintKinds <= kKinds);

// Small for what is near 0, on either side.
std::uint64_t unsigned_of(std::int64_t number) {
  return static_cast<std::uint64_t>(number) << 1 ^ static_cast<std::uint64_t>(number >> 63);
}

std::int64_t signed_of(std::uint64_t number) {
  return static_cast<std::int64_t>(number >> 1) ^ -static_cast<std::int64_t>(number & 1);
}

void put(std::uint64_t number, std::string& bytes) {
  for (; number >= 0x80; number >>= 7) bytes.push_back(static_cast<char>(number | 0x80));
  bytes.push_back(static_cast<char>(number));
}

std::uint64_t take(std::string_view& bytes) {
  std::uint64_t number = 0;
  for (unsigned shift = 0;; shift += 7) {
    GROVE_ASSERT(!bytes.empty() && shift < 64, "what was packed is whole");
    const auto byte = static_cast<unsigned char>(bytes.front());
    bytes.remove_prefix(1);
    number |= static_cast<std::uint64_t>(byte & 0x7F) << shift;
    if (byte < 0x80) return number;
  }
}

// The difference from what it is near to, or 0 for one value that is often there and far from all.
template <class Number>
std::uint64_t near_or(Number value, Number near, Number far) {
  return value == far ? 0 : 1 + unsigned_of(std::int64_t{value} - near);
}

template <class Number>
Number value_of(std::uint64_t number, Number near, Number far) {
  return number == 0 ? far : static_cast<Number>(near + signed_of(number - 1));
}

}  // namespace

void pack(std::span<const Constraint> constraints, std::string& bytes) {
  Constraint last{.cell = 0};
  for (const Constraint& c : constraints) {
    const auto kind = static_cast<std::uint64_t>(c.kind);
    put(unsigned_of(std::int64_t{c.cell} - last.cell) * kKinds + kind, bytes);
    put(near_or(c.from, c.cell, kNoCell), bytes);
    put(unsigned_of(std::int64_t{c.begin} - last.begin), bytes);
    put(near_or(c.end, c.begin, kNever), bytes);
    last = c;
  }
}

std::vector<Constraint> unpacked_constraints(std::string_view bytes) {
  std::vector<Constraint> constraints;
  Constraint last{.cell = 0};
  while (!bytes.empty()) {
    const std::uint64_t kind_and_cell = take(bytes);
    last.kind = static_cast<ConstraintKind>(kind_and_cell % kKinds);
    last.cell = static_cast<Cell>(last.cell + signed_of(kind_and_cell / kKinds));
    last.from = value_of(take(bytes), last.cell, kNoCell);
    last.begin = static_cast<Time>(last.begin + signed_of(take(bytes)));
    last.end = value_of(take(bytes), last.begin, kNever);
    constraints.push_back(last);
  }
  return constraints;
}

}  // namespace grove::detail
