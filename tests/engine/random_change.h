// SPDX-License-Identifier: MIT
// What may happen to robots that drive a plan.
#pragma once

#include <vector>

#include "execution/change.h"
#include "execution/delay.h"
#include "model/random.h"

namespace grove::detail::testing {

// One robot, or two, late by a few of the `time` steps that they have driven; none now and then.
std::vector<Delay> random_delays(const Instance& instance, Time time, Random& random);

// A task that has come, one that is dropped, a cell or a road that is closed: at least one of
// these, of which some cannot be (a robot is there).
InstanceChange random_change(const Instance& instance, Random& random);

}  // namespace grove::detail::testing
