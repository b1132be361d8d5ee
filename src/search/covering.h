// SPDX-License-Identifier: MIT
// Lower bound on the cost of all agents from lower bounds for groups: weighted vertex cover on a
// hypergraph.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/instance.h"
#include "model/limits.h"
#include "model/plan.h"

namespace grove::detail {

// Statement that `agents` together cost at least `excess` more than the sum of their individual
// costs.
struct GroupExcess {
  std::vector<AgentIndex> agents;
  Cost excess = 0;  // positive; kInfiniteCost: there is no plan for these agents
};

// Returns a lower bound on how much more all agents together cost than the sum of their individual
// costs. This is the least sum of nonnegative integers, one per agent, such that the integers of
// each statement's agents add up to at least its excess. If all statements are about pairs, this is
// a weighted vertex cover (Li et al., IJCAI 2019). The result is this sum unless more than `steps`
// statements must be examined, the sum over one connected component of the statements exceeds 256,
// or a limit is reached. In these cases it can be smaller, but it is still a valid bound. At most
// kInfiniteCost. Unless a limit is reached, the result depends only on `statements` and `steps`.
Cost covering_bound(std::span<const GroupExcess> statements, std::int64_t steps = 100'000,
                    const Limits& limits = Limits());

}  // namespace grove::detail
