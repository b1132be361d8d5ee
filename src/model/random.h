// SPDX-License-Identifier: MIT
// Pseudorandom numbers that are the same on every machine. The C++ standard specifies the output of
// std::mt19937_64 and std::seed_seq exactly, but not that of its distributions and of std::shuffle.
// Therefore this file implements its own draws and shuffles.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "model/assert.h"

namespace grove::detail {

// Draw number `number` >= 0 of the sequence with seed `seed`, in [0, 1). It is a function of the
// two arguments, independent of all other draws made (SplitMix64, Steele, Lea and Flood, 2014).
inline double unit_draw(std::uint64_t seed, std::uint64_t number) {
  std::uint64_t z = seed + (number + 1) * 0x9E3779B97F4A7C15;
  z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9;
  z = (z ^ z >> 27) * 0x94D049BB133111EB;
  return static_cast<double>((z ^ z >> 31) >> 11) * 0x1p-53;
}

// A pseudorandom sequence that depends only on its seed. One thread at a time.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  // One of several sequences with the same seed, distinguished by `use`.
  Random(std::uint64_t seed, std::uint32_t use) : engine_(of_use(seed, use)) {}

  // A uniform draw from 0, ..., bound - 1. Precondition: bound > 0.
  template <std::integral Int>
  Int below(Int bound) {
    GROVE_ASSERT(bound > 0, "the range of a draw is not empty");
    const auto n = static_cast<std::uint64_t>(bound);
    std::uint64_t draw = engine_();
    // Rejects draws below 2^64 mod n, so that the result is uniform.
    while (draw < n && draw < -n % n) draw = engine_();
    return static_cast<Int>(draw % n);
  }
  // A uniform draw from [0, 1).
  double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }

  template <class T>
  void shuffle(std::vector<T>& items) {
    for (std::size_t left = items.size(); left > 1; --left)
      std::swap(items[left - 1], items[below(left)]);
  }

 private:
  static std::mt19937_64 of_use(std::uint64_t seed, std::uint32_t use) {
    std::seed_seq words{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32),
                        use};
    return std::mt19937_64(words);
  }

  std::mt19937_64 engine_;
};

// The output function of SplitMix64 (Steele, Lea and Flood, 2014). Flipping one bit of `x` flips
// about half of the bits of the result.
inline std::uint64_t scramble(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

// The generator SplitMix64: fast random numbers for breaking ties. One thread at a time.
class SplitMix64 {
 public:
  explicit SplitMix64(std::uint64_t seed) : state_(seed) {}

  std::uint32_t next() {
    const std::uint64_t number = scramble(state_);
    state_ += 0x9e3779b97f4a7c15u;
    return static_cast<std::uint32_t>(number >> 32);
  }
  // A draw from 0, ..., n - 1. Precondition: n > 0. The distribution is uniform up to a relative
  // error of n / 2^32, so n should be small.
  std::uint32_t below(std::uint32_t n) {
    GROVE_ASSERT(n > 0, "the range of a draw is not empty");
    return static_cast<std::uint32_t>(std::uint64_t{next()} * n >> 32);
  }

 private:
  std::uint64_t state_;
};

}  // namespace grove::detail
