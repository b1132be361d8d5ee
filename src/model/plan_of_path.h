// SPDX-License-Identifier: MIT
// Derives an agent's plan from a path that consists of states only.
#pragma once

#include "model/plan.h"

namespace grove::detail {

// The plan of an agent that follows this path. Precondition: the path ends at rest with every task
// visited. The stops are ordered by their first visits. If the agent rests on its last stop, the
// stop at the end of the path comes last.
AgentPlan plan_of_path(const Instance& instance, AgentIndex agent, const Path& path);

}  // namespace grove::detail
