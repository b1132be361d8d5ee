// SPDX-License-Identifier: MIT
// SplitMix64: fast random numbers for tie-breaking, identical on every machine.
#pragma once

#include <cstdint>

namespace grove::detail {

// The finaliser of SplitMix64 (Steele, Lea and Flood, 2014): flipping one bit flips about half.
inline std::uint64_t scramble(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

// SplitMix64 itself.
class SplitMix64 {
 public:
  explicit SplitMix64(std::uint64_t seed) : state_(seed) {}

  std::uint32_t next() {
    const std::uint64_t number = scramble(state_);
    state_ += 0x9e3779b97f4a7c15u;
    return static_cast<std::uint32_t>(number >> 32);
  }
  // One of 0 .. n-1; n > 0 and small.
  std::uint32_t below(std::uint32_t n) {
    return static_cast<std::uint32_t>(std::uint64_t{next()} * n >> 32);
  }

 private:
  std::uint64_t state_;
};

}  // namespace grove::detail
