// SPDX-License-Identifier: MIT
// What is left to do when a plan has been driven for a while.
#pragma once

#include <cstdint>

#include "grove/detail/model/plan.h"

namespace grove::detail {

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
// rest there. `plan` must be a valid one, but that some agents' parts of it may end too soon and
// leave tasks out, of what they say (change.h).
// With `rests` kWhereItMust the remainder serves to go on with a plan of `instance`: an agent
// without a destination that has visited everything is not idle but ends on one of the places where
// it may by `instance`, on that of `plan` if it can be. Throws InstanceError if two would end on
// one.
enum class Rests : std::uint8_t { kAnywhere, kWhereItMust };
Remainder advance(const Instance& instance, const Plan& plan, Time time,
                  Rests rests = Rests::kAnywhere);

// When the agent comes to rest if its plan ends after `time` steps.
Time finish_of_steps(const AgentPlan& plan, Time time);

// The plan of `instance` that begins as `plan` does, in its first `time` steps, and then goes on as
// `rest`, a valid plan of advance(instance, plan, time).instance.
Plan joined(const Instance& instance, const Plan& plan, Time time, const Instance& later,
            const Plan& rest);

}  // namespace grove::detail
