// SPDX-License-Identifier: MIT
// Random number generator for tests.
#pragma once

#include <vector>

#include "model/random.h"

namespace grove::detail::fuzz {

class Random : public grove::detail::Random {
 public:
  using grove::detail::Random::Random;

  // Returns an integer from `low` to `high`, both inclusive.
  int between(int low, int high) { return low + below(high - low + 1); }
  bool percent(int chance) { return below(100) < chance; }

  template <typename T>
  const T& pick(const std::vector<T>& items) {
    return items[below(items.size())];
  }
};

}  // namespace grove::detail::fuzz
