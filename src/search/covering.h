// SPDX-License-Identifier: MIT
// What many statements about groups of agents say about all agents together.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/instance.h"
#include "model/limits.h"
#include "model/plan.h"

namespace grove::detail {

// "These agents together cost at least `excess` more than they do now."
struct GroupExcess {
  std::vector<AgentIndex> agents;
  Cost excess = 0;  // positive; kInfiniteCost: they cannot all be served
};

// A lower bound on how much more all agents together cost: the least sum of nonnegative integers,
// one per agent, that fulfils every statement; a weighted vertex cover where all are about pairs
// (Li et al., IJCAI 2019). Exact unless more than `steps` statements must be looked at for that, or
// the sum is in the hundreds, or a limit strikes; then still a valid bound. At most kInfiniteCost.
// Depends on the statements alone, but for limits that strike.
Cost covering_bound(std::span<const GroupExcess> statements, std::int64_t steps = 100'000,
                    const Limits& limits = Limits());

}  // namespace grove::detail
