// SPDX-License-Identifier: MIT
// Basic types for the order of visits of one agent: stops, sets of stops and sequences; and sums of
// costs that can be kNever.
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
// The set of the stops 0, ..., stops - 1; at most 64 stops.
inline StopSet all_stops(int stops) {
  return stops == 64 ? ~StopSet{0} : (StopSet{1} << stops) - 1;
}
// The set of one stop.
constexpr StopSet bit(int stop) {
  return StopSet{1} << stop;
}

// Calls visit(stop) for every stop of `set`, in ascending order.
template <class Visit>
constexpr void for_each_stop(StopSet set, Visit visit) {
  for (; set != 0; set &= set - 1) visit(std::countr_zero(set));
}

// Stops in the order of their visits; complete if it contains all n stops of the agent.
using Sequence = std::vector<Stop>;

// Sum of two costs from 0 to kNever, cut off at kNever.
constexpr Time add_costs(Time a, Time b) {
  return std::min(a + (b - kNever), 0) + kNever;
}

struct CostMatrix;  // cost_matrix.h

}  // namespace grove::detail
