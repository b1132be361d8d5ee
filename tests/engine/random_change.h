// SPDX-License-Identifier: MIT
// Random delays and random instance changes during the execution of a plan.
#pragma once

#include <vector>

#include "execution/change.h"
#include "execution/delay.h"
#include "model/random.h"

namespace grove::detail::testing {

// Returns delays of at most two robots, each of 1 to min(12, `time`) steps. `time`: steps by which
// the plan is advanced; if it is 0, there are no delays.
std::vector<Delay> random_delays(const Instance& instance, Time time, Random& random);

// Returns a change that does one or more of these: add a task; drop a task, if there is one; close
// a place or a road. The change can be impossible, for instance if it closes the cell of a robot.
InstanceChange random_change(const Instance& instance, Random& random);

}  // namespace grove::detail::testing
