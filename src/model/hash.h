// SPDX-License-Identifier: MIT
// Hashes of sequences of values. Two different sequences have the same hash with a probability of
// about 2^-64.
#pragma once

#include <cstdint>

namespace grove::detail {

// The same on every machine. Two multiplications carry low bits of the arguments to high bits of
// the result, two shifts carry high bits to low bits.
inline std::uint64_t hash_combine(std::uint64_t hash, std::uint64_t value) {
  hash = (hash ^ value) * 0x9E3779B97F4A7C15u;
  hash ^= hash >> 32;
  hash *= 0xD6E8FEB86659FD93u;
  return hash ^ hash >> 29;
}

}  // namespace grove::detail
