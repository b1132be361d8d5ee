// SPDX-License-Identifier: MIT
// Names of what is made of many values: two that are not the same have one with a chance of 2^-64.
#pragma once

#include <cstdint>

namespace grove::detail {

// The same on every machine. All bits of the result depend on all of both.
inline std::uint64_t hash_combine(std::uint64_t hash, std::uint64_t value) {
  hash = (hash ^ value) * 0x9E3779B97F4A7C15u;
  hash ^= hash >> 32;
  hash *= 0xD6E8FEB86659FD93u;
  return hash ^ hash >> 29;
}

}  // namespace grove::detail
