// SPDX-License-Identifier: MIT
// Cost matrix of the sequencing problem of one agent: least costs of the legs between its stops,
// without other agents.
#pragma once

#include <cstddef>
#include <vector>

#include "model/distance_field.h"
#include "model/instance.h"
#include "sequencing/sequence.h"

namespace grove::detail {

// Least cost of each leg of one agent, in steps; kNever if no path exists or, for legs from the
// start, if the agent must first complete a task execution at another stop. A leg from a stop costs
// the least distance from any base state on this stop. Row-major (n+1) x (n+1) for n stops: entry
// (i, j) is the leg from stop i to stop j; row n has the legs from the start of the agent, and
// column n those to its place of rest (zero if the agent rests on its last stop). Entry (n, n) is
// used only if n = 0.
//
// If agents turn, the cost after a stop depends on the heading in which the agent is on it. Then a
// matrix can have p *ports* per stop, one for each heading: entry (i, j) is the leg from port i to
// port j, and stop s has the ports p * s, ..., p * s + p - 1. Such a matrix is exact. A matrix with
// one port per stop holds least costs over the headings.
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
  int ports = 1;  // number of ports of each stop

  int stops() const { return (cost.size() - 1) / ports; }
  Time from_start(int port) const { return cost(cost.size() - 1, port); }
  Time between(int from, int to) const { return cost(from, to); }
  Time to_end(int port) const { return cost(port, cost.size() - 1); }
  // The set of all stops.
  StopSet all() const { return all_stops(stops()); }
};

// Returns the matrix with one port per stop.
CostMatrix cost_matrix(const Instance& instance, AgentIndex agent, const DistanceFields& distances);
// Returns the matrix with ports if the agent turns, distances to ports are available and take
// little enough memory, and the agent does not start within a turn (it could execute a task there
// without completing the turn). Otherwise returns cost_matrix().
CostMatrix port_matrix(const Instance& instance, AgentIndex agent, const DistanceFields& distances);
// Returns the matrix of least costs over the ports, which is `matrix` if it has one port per stop.
CostMatrix min_matrix(const CostMatrix& matrix);

// Returns the cost of a complete sequence; kNever if one of its legs has no path. Requires one port
// per stop.
Time sequence_cost(const CostMatrix& matrix, const Sequence& sequence);

// Returns the parity of the cost of every complete sequence, or -1 if no common parity is known.
// All sequences have a common parity if the parity of each leg is the sum of a number for its first
// stop and a number for its last stop, because a sequence enters and leaves each stop once. Returns
// -1 for a matrix with several ports per stop.
int common_parity(const CostMatrix& matrix);

}  // namespace grove::detail
