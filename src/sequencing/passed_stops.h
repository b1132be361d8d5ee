// SPDX-License-Identifier: MIT
// Stops that a leg passes: an optimal sequence need not postpone them beyond this leg.
#pragma once

#include <cstddef>
#include <vector>

#include "sequencing/cost_matrix.h"
#include "sequencing/sequence.h"

namespace grove::detail {

// For each leg of a matrix with one port per stop: the stops that the leg passes (defined in the
// .cpp). Immutable: any thread may read it.
class PassedStops {
 public:
  explicit PassedStops(const CostMatrix& matrix);

  // Returns the stops that are passed on the leg from a row of the matrix (a stop or the start) to
  // a stop.
  StopSet on_leg(int from, int to) const {
    return passed_[static_cast<std::size_t>(from * stops_ + to)];
  }

 private:
  int stops_;
  std::vector<StopSet> passed_;
};

}  // namespace grove::detail
