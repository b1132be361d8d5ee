// SPDX-License-Identifier: MIT
// 64-bit hashes of sequences of values. Different sequences have equal hashes with a probability of
// about 2^-64.
#pragma once

#include <cstdint>

namespace grove::detail {

// Returns the hash of a sequence that continues with `value` after a prefix with hash `hash`. The
// result is the same on every machine. The multiplications carry low bits of the arguments to high
// bits of the result; the shifts carry high bits to low bits.
inline std::uint64_t hash_combine(std::uint64_t hash, std::uint64_t value) {
  hash = (hash ^ value) * 0x9E3779B97F4A7C15u;
  hash ^= hash >> 32;
  hash *= 0xD6E8FEB86659FD93u;
  return hash ^ hash >> 29;
}

}  // namespace grove::detail
