// SPDX-License-Identifier: MIT
// Reference for single-agent search in any world. Implements the definition, one time step after
// another, or enumerates orders.
#pragma once

#include <optional>
#include <vector>

#include "model/instance.h"
#include "planning/constraint.h"
#include "sequencing/rtsp.h"

namespace grove::detail::testing {

// Returns the least cost of a path of the agent that realizes a sequence of the class and satisfies
// the constraints, or nullopt if there is no such path. An agent on a stop that takes no time may
// or may not count it as visited. A stop that takes time counts when its execution is completed.
std::optional<Time> world_reference_cost(const Instance& instance, AgentIndex agent,
                                         const SequenceClass& work,
                                         const std::vector<Constraint>& constraints);

}  // namespace grove::detail::testing
