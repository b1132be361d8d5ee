// SPDX-License-Identifier: MIT
// Random delays and random instance changes during the execution of a plan.
#pragma once

#include <vector>

#include "execution/change.h"
#include "execution/delay.h"
#include "model/random.h"

namespace grove::detail::testing {

// Delays at most two robots. Each gets a delay of at most 12 of the `time` steps of the plan
// executed so far.
std::vector<Delay> random_delays(const Instance& instance, Time time, Random& random);

// Returns a change that adds a task, drops a task, closes a cell or closes a road, or several of
// these. The change can be impossible, for instance if it closes the cell of a robot.
InstanceChange random_change(const Instance& instance, Random& random);

}  // namespace grove::detail::testing
