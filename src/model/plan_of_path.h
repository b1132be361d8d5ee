// SPDX-License-Identifier: MIT
// What an agent does on a path of which only the states are known.
#pragma once

#include "model/plan.h"

namespace grove::detail {

// The plan of an agent that walks this path, which ends at rest with everything visited. Its stops
// come in the order of their first visits; where it rests on the last one, that is where it ends.
AgentPlan plan_of_path(const Instance& instance, AgentIndex agent, const Path& path);

}  // namespace grove::detail
