// SPDX-License-Identifier: MIT
// Cost matrix of one agent's sequencing problem: shortest legs between its stops, without other
// agents.
#pragma once

#include <cstddef>
#include <vector>

#include "model/distance_field.h"
#include "model/instance.h"
#include "sequencing/sequence.h"

namespace grove::detail {

// Least cost of each leg of one agent, in steps; kNever if there is no path. A leg costs the
// shortest distance, or the least distance from any base state on the stop that it leaves.
// Row-major (n+1) x (n+1): entry (i, j) from stop i to stop j; row n from the agent's start; column
// n to its destination (zero for an MG agent, which finishes on a stop). Entry (n, n) matters only
// for n = 0.
//
// If agents turn, the cost of what follows a stop depends on the heading in which the agent is
// there. Then a matrix may have several *ports* per stop, one for each heading: entry (i, j) from
// port i to port j, ports 0 .. p - 1 being those of stop 0, and so on. Such a matrix is exact; one
// without ports holds the least costs over the ports.
struct CostMatrix {
  // Square, row-major.
  class Matrix {
   public:
    Matrix() = default;
    explicit Matrix(int size, Time entry = 0)
        : size_(size), entries_(static_cast<std::size_t>(size) * size, entry) {}
    int size() const { return static_cast<int>(size_); }
    Time& operator()(std::ptrdiff_t row, std::ptrdiff_t column) {
      return entries_[row * size_ + column];
    }
    Time operator()(std::ptrdiff_t row, std::ptrdiff_t column) const {
      return entries_[row * size_ + column];
    }
    friend bool operator==(const Matrix&, const Matrix&) = default;

   private:
    std::ptrdiff_t size_ = 0;
    std::vector<Time> entries_;
  };

  Matrix cost;
  int ports = 1;  // of each stop

  int stops() const { return (cost.size() - 1) / ports; }
  Time from_start(int port) const { return cost(cost.size() - 1, port); }
  Time between(int from, int to) const { return cost(from, to); }
  Time to_end(int port) const { return cost(port, cost.size() - 1); }
  // The set of all stops.
  StopSet all() const { return all_stops(stops()); }
};

CostMatrix cost_matrix(const Instance& instance, AgentIndex agent, const DistanceFields& distances);
// The matrix with ports, if the agent turns, distances to the ports are known and not too many, and
// the agent does not start within a turn (it could work there and turn no further). Otherwise
// cost_matrix().
CostMatrix port_matrix(const Instance& instance, AgentIndex agent, const DistanceFields& distances);
// The matrix of least costs over the ports. Equal to `matrix` if that has one port per stop.
CostMatrix min_matrix(const CostMatrix& matrix);

// Returns the cost of a complete sequence, kNever if one of its legs has no path.
Time sequence_cost(const CostMatrix& matrix, const Sequence& sequence);

// Returns the parity of every complete sequence, or -1 if they need not share one. They share one
// if the parity of each leg is the sum of a number of its first stop and a number of its last stop,
// because each stop is entered once and left once.
int common_parity(const CostMatrix& matrix);

}  // namespace grove::detail
