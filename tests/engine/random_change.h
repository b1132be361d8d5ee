// SPDX-License-Identifier: MIT
// Random delays of robots and random changes of an instance during the execution of a plan.
#pragma once

#include <vector>

#include "execution/change.h"
#include "execution/delay.h"
#include "model/random.h"

namespace grove::detail::testing {

// Delays at most two robots by up to 12 of the `time` steps of the plan that they have executed.
std::vector<Delay> random_delays(const Instance& instance, Time time, Random& random);

// Adds a task, drops one, or closes a cell or a road: at least one of these. Some of these changes
// are impossible, for instance closing the cell of a robot.
InstanceChange random_change(const Instance& instance, Random& random);

}  // namespace grove::detail::testing
