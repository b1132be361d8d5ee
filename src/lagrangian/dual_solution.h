// SPDX-License-Identifier: MIT
// Dual solution: the result of a round of the Lagrangian bound, for the primal search.
#pragma once

#include <numeric>
#include <vector>

#include "lagrangian/multipliers.h"
#include "lagrangian/penalized_search.h"

namespace grove::detail {

// Multipliers and the agents' subproblem values under them. The cost of a plan minus bound() is the
// sum of its paths' penalised costs above their subproblem values, plus the multipliers of the rows
// that it does not use. A value.
struct DualSolution {
  // Proven: no plan costs less.
  ScaledCost bound() const {
    return std::accumulate(values.begin(), values.end(), -multipliers.sum());
  }

  Multipliers multipliers;
  std::vector<ScaledCost> values;  // subproblem values, by agent
  std::vector<Path> paths;         // of these values; empty: no path is known
};

}  // namespace grove::detail
