// SPDX-License-Identifier: MIT
// An agent's order of visits.
#pragma once

#include <cstdint>
#include <vector>

namespace grove::detail {

// One of an agent's own tasks, as its position in Agent::tasks: 0 .. n-1.
using Stop = std::uint8_t;
// A set of stops: bit s stands for stop s.
using StopSet = std::uint64_t;
// All of `stops`, at most 64.
inline StopSet all_stops(int stops) {
  return stops == 64 ? ~StopSet{0} : (StopSet{1} << stops) - 1;
}
// Stops in the order of their visits; complete when it holds all n.
using Sequence = std::vector<Stop>;

// See cost_matrix.h, which only those include who look into one: Eigen is a third of a compilation.
struct CostMatrix;

}  // namespace grove::detail
