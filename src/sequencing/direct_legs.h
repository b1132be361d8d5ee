// SPDX-License-Identifier: MIT
// Legs of one agent that pass no other stop on their way.
#pragma once

#include <vector>

#include "model/instance.h"
#include "sequencing/cost_matrix.h"

namespace grove::detail {

// A *plain* stop takes no time, so an agent visits it by passing. Entry (i, j) is a lower bound on
// every way from i to j that is on the place of no plain stop but i and j, and never less than that
// of `matrix`, the agent's own; kNever when there is proven to be no such way. The column to the
// end is that of `matrix`. O(ports * moves of the world).
CostMatrix direct_legs(const Instance& instance, AgentIndex agent, const CostMatrix& matrix);

// Direct legs, and by which stops an agent passes from one port to another more cheaply than
// directly. Immutable; any thread may read it.
class DirectLegs {
 public:
  // `direct` and `matrix` are of the same stops and ports.
  DirectLegs(CostMatrix direct, const CostMatrix& matrix);

  Time leg(int from, int to) const { return direct_.cost(from, to); }
  // The ports from which some third port is nearer, by any ways, than it is directly from `port`.
  const std::vector<int>& hops(int port) const { return hops_[static_cast<std::size_t>(port)]; }
  const CostMatrix& matrix() const { return direct_; }
  // Does every finite leg have the parity of the matrix?
  bool keeps_parity() const { return keeps_parity_; }

 private:
  CostMatrix direct_;
  std::vector<std::vector<int>> hops_;  // by port
  bool keeps_parity_ = true;
};

}  // namespace grove::detail
