// SPDX-License-Identifier: MIT
// What is left to do when a plan has been driven for a while.
#pragma once

#include <cstdint>
#include <vector>

#include "model/plan.h"

namespace grove::detail {

// An instance as it is some time later, and what is left of a plan of the one before, time from 0.
struct Remainder {
  Instance instance;
  Plan plan;
  // By AgentIndex: it has its destination only for the sake of `plan`, see below.
  std::vector<bool> ends_with_plan;
};

// After `time` >= 0 steps by the clock: everybody stands where the plan has them then, on a road,
// within a turn or at work; what they have visited is left out, and tasks that nobody has to visit
// any more are gone. Agents keep their order and their ids, tasks their ids. An agent without a
// destination that has visited everything is idle. One with tasks left may rest on one of these,
// for an instance cannot say that it may also rest on one that it has visited. If `plan` leads it
// to such a place, it gets that as its destination, so that the plan stays valid; the remainder
// says so in `ends_with_plan`, and without_ends_of_plan() takes that back. `plan` must be a valid
// one, but that some agents' parts of it may end too soon and leave tasks out, of what they say
// (change.h). `before`: `ends_with_plan` of an earlier remainder, of which `instance` is the
// instance; empty if there was none.
// With `rests` kWhereItMust the remainder serves to go on with a plan of `instance`: an agent
// without a destination that has visited everything is not idle but ends on one of the places where
// it may by `instance`, on that of `plan` if it can be. Throws InstanceError if two would end on
// one.
enum class Rests : std::uint8_t { kAnywhere, kWhereItMust };
Remainder advance(const Instance& instance, const Plan& plan, Time time,
                  Rests rests = Rests::kAnywhere, const std::vector<bool>& before = {});

// The instance in which these agents have no destination, and the one in which they have that place
// as their destination where their path in `plan` ends.
Instance without_ends_of_plan(const Instance& instance, const std::vector<bool>& agents);
Instance with_ends_of_plan(const Instance& instance, const Plan& plan,
                           const std::vector<bool>& agents);

// When the agent comes to rest if its plan ends after `time` steps.
Time finish_of_steps(const AgentPlan& plan, Time time);

// The plan of `instance` that begins as `plan` does, in its first `time` steps, and then goes on as
// `rest`, a valid plan of advance(instance, plan, time).instance.
Plan joined(const Instance& instance, const Plan& plan, Time time, const Instance& later,
            const Plan& rest);

}  // namespace grove::detail
