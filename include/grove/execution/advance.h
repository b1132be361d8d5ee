// SPDX-License-Identifier: MIT
// What is left to do when a plan has been driven for a while.
#pragma once

#include "grove/model/plan.h"

namespace grove {

// An instance as it is some time later, and what is left of a plan of the one before, time from 0.
struct Remainder {
  Instance instance;
  Plan plan;
};

// After `time` >= 0 steps by the clock: everybody stands where the plan has them then, on a road,
// within a turn or at work; what they have visited is left out, and tasks that nobody has to visit
// any more are gone. Agents keep their order and their ids, tasks their ids. An agent without a
// destination that has visited everything is idle; one that has tasks left but is going to rest on
// one that it has visited has that place as its destination, for an instance cannot say that it may
// rest there. `plan` must be a valid one.
Remainder advance(const Instance& instance, const Plan& plan, Time time);

}  // namespace grove
