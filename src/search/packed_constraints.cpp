// SPDX-License-Identifier: MIT
// Four numbers for each constraint, of 7 bits to a byte, the last of which has its high bit clear:
// kind and cell, place of departure, begin, end.
//
// *Claim: different lists have different bytes.* Each number says where it ends, and with those
// before it which value it stands for; so the list can be told from its bytes, which the test does.
#include "grove/detail/search/packed_constraints.h"

#include <cstdint>

namespace grove::detail {
namespace {

constexpr std::uint64_t kKinds = 8;
static_assert(kConstraintKinds <= kKinds);

// Small for what is near 0, on either side.
std::uint64_t unsigned_of(std::int64_t number) {
  return static_cast<std::uint64_t>(number) << 1 ^ static_cast<std::uint64_t>(number >> 63);
}

void put(std::uint64_t number, std::string& bytes) {
  for (; number >= 0x80; number >>= 7) bytes.push_back(static_cast<char>(number | 0x80));
  bytes.push_back(static_cast<char>(number));
}

// The difference from what it is near to, or 0 for one value that is often there and far from all.
std::uint64_t near_or(std::int32_t value, std::int32_t near, std::int32_t far) {
  return value == far ? 0 : 1 + unsigned_of(std::int64_t{value} - near);
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

}  // namespace grove::detail
