// SPDX-License-Identifier: MIT
// Reference for single-agent search in any world: by definition, time step by time step, and by
// enumeration of orders.
#pragma once

#include <optional>
#include <vector>

#include "model/instance.h"
#include "planning/constraint.h"
#include "sequencing/rtsp.h"

namespace grove::detail::testing {

// The least cost of a path of the agent that realizes a sequence of the class and satisfies the
// constraints. Returns nullopt if there is no path. An agent on a stop that takes no time may or
// may not count it. A stop that takes time counts when the work is completed.
std::optional<Time> world_reference_cost(const Instance& instance, AgentIndex agent,
                                         const SequenceClass& work,
                                         const std::vector<Constraint>& constraints);

}  // namespace grove::detail::testing
