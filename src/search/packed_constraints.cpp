// SPDX-License-Identifier: MIT
// Encodes each constraint as four numbers: kind and cell, place of departure, begin, end. A number
// is stored with 7 bits per byte; only its last byte has the high bit clear.
//
// *Claim: different lists have different bytes.* *Proof.* The bytes of a number show where it ends
// and, together with the numbers before it, determine the value that it encodes. So the list can be
// decoded from its bytes; the unit test does so.
#include "search/packed_constraints.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace grove::detail {
namespace {

constexpr std::uint64_t kKinds = 8;
static_assert(kConstraintKinds <= kKinds);

// Maps numbers near 0 of either sign to small numbers (zigzag encoding).
std::uint64_t unsigned_of(std::int64_t number) {
  return static_cast<std::uint64_t>(number) << 1 ^ static_cast<std::uint64_t>(number >> 63);
}

constexpr std::size_t kMaxBytes = 10;  // per number

char* put(std::uint64_t number, char* to) {
  for (; number >= 0x80; number >>= 7) *to++ = static_cast<char>(number | 0x80);
  *to++ = static_cast<char>(number);
  return to;
}

// Encodes `value` as its difference from `near`, or as 0 if it is `far`, a frequent value that is
// far from all others.
std::uint64_t near_or(std::int32_t value, std::int32_t near, std::int32_t far) {
  return value == far ? 0 : 1 + unsigned_of(std::int64_t{value} - near);
}

}  // namespace

void pack(std::span<const Constraint> constraints, std::string& bytes) {
  Constraint last{.cell = 0};
  for (const Constraint& c : constraints) {
    std::array<char, 4 * kMaxBytes> packed;
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
