// SPDX-License-Identifier: MIT
// Visiting orders of one agent: stops, sets of stops, sequences.
#pragma once

#include <cstdint>
#include <vector>

namespace grove::detail {

// One of an agent's own tasks, as its index in Agent::tasks: 0 .. n-1.
using Stop = std::uint8_t;
// A set of stops: bit s stands for stop s.
using StopSet = std::uint64_t;
// The set of all of `stops` stops, at most 64.
inline StopSet all_stops(int stops) {
  return stops == 64 ? ~StopSet{0} : (StopSet{1} << stops) - 1;
}
// Stops in the order of their visits; complete if it holds all n.
using Sequence = std::vector<Stop>;

struct CostMatrix;  // cost_matrix.h

}  // namespace grove::detail
