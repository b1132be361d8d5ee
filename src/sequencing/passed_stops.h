// SPDX-License-Identifier: MIT
// Stops that an optimal sequence need not leave for later.
#pragma once

#include <cstddef>
#include <vector>

#include "sequencing/cost_matrix.h"
#include "sequencing/sequence.h"

namespace grove::detail {

// For each leg of a matrix with one port a stop: the stops that lie on its way (see the .cpp).
// Immutable; any thread may read it.
class PassedStops {
 public:
  explicit PassedStops(const CostMatrix& matrix);

  // On the way from a row of the matrix to a stop.
  StopSet on_leg(int from, int to) const {
    return passed_[static_cast<std::size_t>(from * stops_ + to)];
  }

 private:
  int stops_;
  std::vector<StopSet> passed_;
};

}  // namespace grove::detail
