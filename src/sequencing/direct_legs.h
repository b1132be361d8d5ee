// SPDX-License-Identifier: MIT
// Direct legs of one agent: legs that pass no other plain stop.
#pragma once

#include <vector>

#include "model/instance.h"
#include "sequencing/cost_matrix.h"

namespace grove::detail {

// A *plain* stop takes no time, so an agent visits it by passing. Entry (i, j) is a lower bound on
// every path from i to j that is on the place of no plain stop except i and j. It is never less
// than the entry of `matrix`, the agent's cost matrix. kNever: there is proven to be no such path.
// The column to the end is that of `matrix`. O(ports * moves of the world).
CostMatrix direct_legs(const Instance& instance, AgentIndex agent, const CostMatrix& matrix);

// Direct legs, and hops: the ports by which an agent reaches another port more cheaply than
// directly. Immutable: any thread may read it.
class DirectLegs {
 public:
  // `direct` and `matrix` must have the same stops and ports.
  DirectLegs(CostMatrix direct, const CostMatrix& matrix);

  Time leg(int from, int to) const { return direct_.cost(from, to); }
  // Ports h such that going from `port` directly to h, and then by any route to some third port,
  // costs less than the direct leg from `port` to that port.
  const std::vector<int>& hops(int port) const { return hops_[static_cast<std::size_t>(port)]; }
  const CostMatrix& matrix() const { return direct_; }
  // Whether every finite leg has the parity of its entry in the matrix.
  bool keeps_parity() const { return keeps_parity_; }

 private:
  CostMatrix direct_;
  std::vector<std::vector<int>> hops_;  // by port
  bool keeps_parity_ = true;
};

}  // namespace grove::detail
