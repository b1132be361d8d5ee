// SPDX-License-Identifier: MIT
// Sets of stops, and sums of costs that may be kNever.
#pragma once

#include <algorithm>
#include <bit>

#include "model/grid.h"
#include "sequencing/sequence.h"

namespace grove::detail {

constexpr StopSet bit(int stop) {
  return StopSet{1} << stop;
}

// Calls visit(stop) for every member, in ascending order.
template <class Visit>
constexpr void for_each_stop(StopSet set, Visit visit) {
  for (; set != 0; set &= set - 1) visit(std::countr_zero(set));
}

// Sum of two costs, each at most kNever; kNever absorbs.
constexpr Time add_costs(Time a, Time b) {
  return std::min(a + (b - kNever), 0) + kNever;
}

}  // namespace grove::detail
