// SPDX-License-Identifier: MIT
// Hashes of sequences of values. Two different sequences have the same hash with a probability of
// 2^-64.
#pragma once

#include <cstdint>

namespace grove::detail {

// The same on every machine. Every bit of the result depends on all bits of both arguments.
inline std::uint64_t hash_combine(std::uint64_t hash, std::uint64_t value) {
  hash = (hash ^ value) * 0x9E3779B97F4A7C15u;
  hash ^= hash >> 32;
  hash *= 0xD6E8FEB86659FD93u;
  return hash ^ hash >> 29;
}

}  // namespace grove::detail
