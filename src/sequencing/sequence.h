// SPDX-License-Identifier: MIT
// Visiting orders of one agent: stops, sets of stops, sequences, and sums of costs that may be
// kNever.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include "model/grid.h"

namespace grove::detail {

// A stop of an agent, as its position in Agent::stops: 0 .. n-1.
using Stop = std::uint8_t;
// A set of stops: bit s stands for stop s.
using StopSet = std::uint64_t;
// The set of all of `stops` stops, at most 64.
inline StopSet all_stops(int stops) {
  return stops == 64 ? ~StopSet{0} : (StopSet{1} << stops) - 1;
}
// The set of one stop.
constexpr StopSet bit(int stop) {
  return StopSet{1} << stop;
}

// Calls visit(stop) for every member, in ascending order.
template <class Visit>
constexpr void for_each_stop(StopSet set, Visit visit) {
  for (; set != 0; set &= set - 1) visit(std::countr_zero(set));
}

// Stops in the order of their visits; complete if it holds all n.
using Sequence = std::vector<Stop>;

// Sum of two costs, each at most kNever; kNever absorbs.
constexpr Time add_costs(Time a, Time b) {
  return std::min(a + (b - kNever), 0) + kNever;
}

struct CostMatrix;  // cost_matrix.h

}  // namespace grove::detail
