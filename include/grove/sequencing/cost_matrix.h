// SPDX-License-Identifier: MIT
// What one agent's order of visits costs when nobody is in the way.
#pragma once

#include <Eigen/Core>

#include "grove/model/distance_field.h"
#include "grove/model/instance.h"
#include "grove/sequencing/sequence.h"

namespace grove {

// What each leg takes one agent at least, in steps, kNever where there is no way: the shortest
// distance, or the least from any base state on the stop that it leaves. Row-major (n+1) x (n+1):
// entry (i, j) from stop i to stop j; row n from the agent's start; column n to its destination
// (zero for an MG agent, which finishes on a stop). Entry (n, n) matters only for n = 0.
struct CostMatrix {
  using Matrix = Eigen::Matrix<Time, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  Matrix cost;

  int stops() const { return static_cast<int>(cost.rows()) - 1; }
  Time from_start(int stop) const { return cost(stops(), stop); }
  Time between(int from, int to) const { return cost(from, to); }
  Time to_end(int stop) const { return cost(stop, stops()); }
  // All stops, as a set.
  StopSet all() const { return all_stops(stops()); }
};

CostMatrix cost_matrix(const Instance& instance, AgentIndex agent, const DistanceFields& distances);

// The cost of a complete sequence; kNever when a leg has no way.
Time sequence_cost(const CostMatrix& matrix, const Sequence& sequence);

}  // namespace grove
