// SPDX-License-Identifier: MIT
// What one agent's order of visits costs when nobody is in the way.
#pragma once

#include <Eigen/Core>

#include "model/distance_field.h"
#include "model/instance.h"
#include "sequencing/sequence.h"

namespace grove::detail {

// What each leg takes one agent at least, in steps, kNever where there is no way: the shortest
// distance, or the least from any base state on the stop that it leaves. Row-major (n+1) x (n+1):
// entry (i, j) from stop i to stop j; row n from the agent's start; column n to its destination
// (zero for an MG agent, which finishes on a stop). Entry (n, n) matters only for n = 0.
//
// Where agents turn, what comes after a stop depends on the heading in which the agent is there. A
// matrix with several *ports* a stop, one for each heading, says so: entry (i, j) from port i to
// port j, ports 0 .. p - 1 being those of stop 0, and so on. Exact then; the other is the least
// over the ports.
struct CostMatrix {
  using Matrix = Eigen::Matrix<Time, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  Matrix cost;
  int ports = 1;  // of each stop

  int stops() const { return (static_cast<int>(cost.rows()) - 1) / ports; }
  Time from_start(int port) const { return cost(cost.rows() - 1, port); }
  Time between(int from, int to) const { return cost(from, to); }
  Time to_end(int port) const { return cost(port, cost.cols() - 1); }
  // All stops, as a set.
  StopSet all() const { return all_stops(stops()); }
};

CostMatrix cost_matrix(const Instance& instance, AgentIndex agent, const DistanceFields& distances);
// With ports, if the agent turns, distances to them are known and not too many, and it does not
// start within a turn (it could work there and turn no further).
CostMatrix port_matrix(const Instance& instance, AgentIndex agent, const DistanceFields& distances);
// The least over the ports; the same if there are none.
CostMatrix least_matrix(const CostMatrix& matrix);

// The cost of a complete sequence; kNever when a leg has no way.
Time sequence_cost(const CostMatrix& matrix, const Sequence& sequence);

}  // namespace grove::detail
