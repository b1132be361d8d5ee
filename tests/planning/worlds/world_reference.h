// SPDX-License-Identifier: MIT
// What a low level must find for one agent of any world, by definition: time step by time step, and
// order by order.
#pragma once

#include <optional>
#include <vector>

#include "model/instance.h"
#include "planning/constraint.h"
#include "sequencing/rtsp.h"

namespace grove::detail::testing {

// The cost of a cheapest path of the agent that realizes a sequence of the class and obeys the
// constraints; none if there is no path. An agent on a stop that takes no time may or may not count
// it; one that takes time counts when the work is completed.
std::optional<Time> world_reference_cost(const Instance& instance, AgentIndex agent,
                                         const SequenceClass& work,
                                         const std::vector<Constraint>& constraints);

}  // namespace grove::detail::testing
