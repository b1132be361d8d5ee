// SPDX-License-Identifier: MIT
// Direct legs of one agent: legs that pass no other plain stop.
#pragma once

#include <vector>

#include "model/instance.h"
#include "sequencing/cost_matrix.h"

namespace grove::detail {

// A *plain* stop takes no time, so an agent visits it by passing. Returns a matrix whose entry (i,
// j) is a lower bound on the length of every path from i to j that is never on the place of a plain
// stop other than i and j. The entry is at least that of `matrix`, the cost matrix of the agent.
// kNever: proven that no such path exists. The column to the end is that of `matrix`. O(ports *
// moves of the world).
CostMatrix direct_legs(const Instance& instance, AgentIndex agent, const CostMatrix& matrix);

// Direct legs, and the hops through which an agent reaches other ports more cheaply than by a
// direct leg. Immutable: any thread may read it.
class DirectLegs {
 public:
  // `direct` and `matrix` must have the same stops and ports.
  DirectLegs(CostMatrix direct, const CostMatrix& matrix);

  Time leg(int from, int to) const { return direct_.cost(from, to); }
  // Ports h such that, for some port q of a stop other than those of `port` and h, the direct leg
  // from `port` to h plus the least cost from h to q is less than the direct leg from `port` to q.
  const std::vector<int>& hops(int port) const { return hops_[static_cast<std::size_t>(port)]; }
  const CostMatrix& matrix() const { return direct_; }
  // True if every finite direct leg has the parity of the corresponding entry in the matrix.
  bool keeps_parity() const { return keeps_parity_; }

 private:
  CostMatrix direct_;
  std::vector<std::vector<int>> hops_;  // by port
  bool keeps_parity_ = true;
};

}  // namespace grove::detail
