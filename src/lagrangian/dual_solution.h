// SPDX-License-Identifier: MIT
// What a round of the Lagrangian bound has found, for those who look for plans.
#pragma once

#include <numeric>
#include <vector>

#include "lagrangian/multipliers.h"
#include "lagrangian/penalized_search.h"

namespace grove::detail {

// A tariff, and what each agent pays under it at least. What a plan pays above that, and what it
// leaves unused of the tariff, make together what it costs above the bound. A value.
struct DualSolution {
  // Proven: no plan costs less.
  ScaledCost bound() const {
    return std::accumulate(prices.begin(), prices.end(), -multipliers.sum());
  }

  Multipliers multipliers;
  std::vector<ScaledCost> prices;  // by agent
  std::vector<Path> paths;         // of those prices; empty where none is known
};

}  // namespace grove::detail
