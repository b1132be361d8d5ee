// SPDX-License-Identifier: MIT
// Dual solution: multipliers and subproblem values of one round of the Lagrangian bound, for the
// primal search.
#pragma once

#include <numeric>
#include <vector>

#include "lagrangian/multipliers.h"
#include "lagrangian/penalized_search.h"

namespace grove::detail {

// Multipliers, and the subproblem value of each agent under these multipliers. The cost of a plan
// minus bound() is equal to the sum over its agents of (penalised cost of the path - subproblem
// value), plus the sum of the multipliers of the rows that the plan does not use. A value type.
struct DualSolution {
  // Lower bound on the cost of every plan, in the unit of ScaledCost.
  ScaledCost bound() const {
    return std::accumulate(values.begin(), values.end(), -multipliers.sum());
  }

  Multipliers multipliers;
  std::vector<ScaledCost> values;  // by agent: subproblem value
  std::vector<Path> paths;         // by agent: the best path found; empty: none
};

}  // namespace grove::detail
