// SPDX-License-Identifier: MIT
// Computes the remaining instance and plan after some steps of a plan were executed.
#pragma once

#include <cstdint>
#include <vector>

#include "model/plan.h"

namespace grove::detail {

// The instance at a later time, and the rest of a plan of the earlier instance. Time is counted
// from 0 again.
struct Remainder {
  Instance instance;
  Plan plan;
  // By AgentIndex: the agent has a destination only so that `plan` stays valid; see advance().
  std::vector<bool> ends_with_plan;
};

// Returns what remains after `time` >= 0 steps by the clock.
// - Each agent starts where the plan has it at that time: on a place, on a road, within a turn or
//   at work.
// - Visited tasks are removed from their agents. Tasks without agents are removed. Agents keep
//   their order and ids; tasks keep their ids.
// - An agent without a destination that has visited all its tasks is idle.
// - An agent without a destination that has tasks left may rest on one of these. An instance cannot
//   express that it may also rest on a task that it has visited. If `plan` leads it to such a
//   place, this place becomes its destination, so that the plan stays valid. `ends_with_plan` marks
//   these agents, and without_ends_of_plan() reverts the change.
//
// `plan` must be valid, except that the plans of some agents may end too early and omit tasks, from
// their sequences too (change.h). `before`: `ends_with_plan` of the earlier remainder whose
// instance is `instance`; empty if there was none.
//
// With `rests` = kWhereItMust the remainder serves to continue a plan of `instance`: an agent
// without a destination that has visited all its tasks is not idle. It ends on one of the places
// where it may rest in `instance`, if possible on the one of `plan`. Throws InstanceError if two
// agents would end on the same place.
enum class Rests : std::uint8_t { kAnywhere, kWhereItMust };
Remainder advance(const Instance& instance, const Plan& plan, Time time,
                  Rests rests = Rests::kAnywhere, const std::vector<bool>& before = {});

// without_ends_of_plan(): the instance in which the agents marked in `agents` have no destination.
// with_ends_of_plan(): the instance in which the destination of each of these agents is the last
// place of its path in `plan`.
Instance without_ends_of_plan(const Instance& instance, const std::vector<bool>& agents);
Instance with_ends_of_plan(const Instance& instance, const Plan& plan,
                           const std::vector<bool>& agents);

// The finish time of an agent whose plan ends after `time` steps.
Time finish_of_steps(const AgentPlan& plan, Time time);

// The plan of `instance` that consists of the first `time` steps of `plan`, followed by `rest`, a
// valid plan of `later` = advance(instance, plan, time).instance.
Plan joined(const Instance& instance, const Plan& plan, Time time, const Instance& later,
            const Plan& rest);

}  // namespace grove::detail
