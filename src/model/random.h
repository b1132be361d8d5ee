// SPDX-License-Identifier: MIT
// Random numbers that are the same everywhere. The standard fixes std::mt19937_64 and std::seed_seq
// to the bit, but neither its distributions nor std::shuffle: those are done here.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

namespace grove::detail {

// The draw of this number of a sequence, in [0, 1): they do not depend on which of them are drawn,
// or when (SplitMix64, Steele et al. 2014).
inline double unit_draw(std::uint64_t seed, std::uint64_t number) {
  std::uint64_t z = seed + (number + 1) * 0x9E3779B97F4A7C15;
  z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9;
  z = (z ^ z >> 27) * 0x94D049BB133111EB;
  return static_cast<double>((z ^ z >> 31) >> 11) * 0x1p-53;
}

// A sequence of draws that the seed settles. For one thread.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  // For one of many uses of a seed: their sequences do not depend on each other.
  Random(std::uint64_t seed, std::uint32_t use) : engine_(of_use(seed, use)) {}

  // A uniform draw from 0 .. bound - 1; `bound` must be positive.
  template <std::integral Int>
  Int below(Int bound) {
    const auto n = static_cast<std::uint64_t>(bound);
    std::uint64_t draw = engine_();
    // 2^64 mod n: so many of the lowest draws are one too many
    while (draw < n && draw < -n % n) draw = engine_();
    return static_cast<Int>(draw % n);
  }
  // In [0, 1).
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

}  // namespace grove::detail
