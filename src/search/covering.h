// SPDX-License-Identifier: MIT
// Lower bound for all agents from lower bounds for groups: weighted vertex cover on a hypergraph.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/instance.h"
#include "model/limits.h"
#include "model/plan.h"

namespace grove::detail {

// The statement that `agents` together cost at least `excess` more than they do now.
struct GroupExcess {
  std::vector<AgentIndex> agents;
  Cost excess = 0;  // positive; kInfiniteCost: there is no plan for these agents
};

// Returns a lower bound on how much more all agents together cost: the least sum of nonnegative
// integers, one per agent, that fulfils every statement. If all statements are about pairs, this is
// a weighted vertex cover (Li et al., IJCAI 2019). Returns exactly this sum unless more than
// `steps` statements must be examined, or the sum is in the hundreds, or a limit is reached; then
// it is still a valid bound, but may be smaller. At most kInfiniteCost. Depends only on the
// arguments `statements` and `steps`, unless a limit is reached.
Cost covering_bound(std::span<const GroupExcess> statements, std::int64_t steps = 100'000,
                    const Limits& limits = Limits());

}  // namespace grove::detail
