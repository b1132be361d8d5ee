// SPDX-License-Identifier: MIT
// Four numbers for each constraint, of 7 bits to a byte, the last of which has its high bit clear:
// kind and cell, place of departure, begin, end.
//
// *Claim: different lists have different bytes.* Each number says where it ends, and with those
// before it which value it stands for; so the list can be told from its bytes, which the test does.
#include "search/packed_constraints.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace grove::detail {
namespace {

constexpr std::uint64_t kKinds = 8;
static_assert(kConstraintKinds <= kKinds);

// Small for what is near 0, on either side.
std::uint64_t unsigned_of(std::int64_t number) {
  return static_cast<std::uint64_t>(number) << 1 ^ static_cast<std::uint64_t>(number >> 63);
}

constexpr std::size_t kMostBytes = 10;  // of a number

char* put(std::uint64_t number, char* to) {
  for (; number >= 0x80; number >>= 7) *to++ = static_cast<char>(number | 0x80);
  *to++ = static_cast<char>(number);
  return to;
}

// The difference from what it is near to, or 0 for one value that is often there and far from all.
std::uint64_t near_or(std::int32_t value, std::int32_t near, std::int32_t far) {
  return value == far ? 0 : 1 + unsigned_of(std::int64_t{value} - near);
}

}  // namespace

void pack(std::span<const Constraint> constraints, std::string& bytes) {
  Constraint last{.cell = 0};
  for (const Constraint& c : constraints) {
    std::array<char, 4 * kMostBytes> packed;
    char* end = packed.data();
    const auto kind = static_cast<std::uint64_t>(c.kind);
    end = put(unsigned_of(std::int64_t{c.cell} - last.cell) * kKinds + kind, end);
    end = put(near_or(c.from, c.cell, kNoCell), end);
    end = put(unsigned_of(std::int64_t{c.begin} - last.begin), end);
    end = put(near_or(c.end, c.begin, kNever), end);
    bytes.append(packed.data(), end);
    last = c;
  }
}

}  // namespace grove::detail
