// SPDX-License-Identifier: MIT
// Random numbers that are the same everywhere. The standard fixes std::mt19937_64 and std::seed_seq
// to the bit, but neither its distributions nor std::shuffle: those are done here.
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

namespace grove {

class Random {
 public:
  // What the numbers are for: different uses of one seed do not depend on each other.
  enum class Use : std::uint32_t { kMap = 1, kScenario = 2, kTasks = 3 };

  Random(std::uint64_t seed, Use use);

  // A uniform draw from 0 .. bound - 1; `bound` must be positive.
  std::size_t below(std::size_t bound);

  template <typename T>
  void shuffle(std::vector<T>& items) {
    for (std::size_t k = items.size(); k > 1; --k) std::swap(items[k - 1], items[below(k)]);
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace grove
