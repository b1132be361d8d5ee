// SPDX-License-Identifier: MIT
// Computes the remainder of an instance and of its plan after some time steps of execution.
#pragma once

#include <cstdint>
#include <vector>

#include "model/plan.h"

namespace grove::detail {

// What remains of an instance and of a plan after some time steps. Time is counted from 0 again.
struct Remainder {
  Instance instance;
  Plan plan;
  // By AgentIndex: true if the agent has been given a destination only so that `plan` is valid; see
  // advance().
  std::vector<bool> ends_with_plan;
};

// Where an agent without a destination may rest in a remainder once it has visited all its tasks:
// anywhere, or only on a place where it may rest in the original instance.
enum class Rests : std::uint8_t { kAnywhere, kWhereItMust };

// Returns the remainder of `instance` and `plan` after `time` >= 0 time steps.
// - Each agent starts in its pose at that time in `plan`: on a vertex or cell, on a road or within
//   a turn, possibly at work.
// - For each agent, the tasks that it has visited are removed from its tasks. Tasks that no agent
//   must visit any more are removed. Agents keep their order and ids; tasks keep their ids.
// - A task with a choice of agents loses the agents that have visited it, and needs as many visits
//   less. If it needs no further visit, it is removed, and an agent that is executing it is free to
//   stop.
// - An agent without a destination that has visited all its tasks becomes idle.
// - An agent without a destination that must visit tasks may rest on one of the remaining tasks. An
//   instance cannot express that it may also rest on a task that it has visited. If `plan` ends on
//   such a task for an agent, that place becomes its destination, so that the plan is valid.
//   `ends_with_plan` marks these agents, and without_ends_of_plan() reverts the change.
//
// `plan` must be valid, except that the plans of some agents may end too early and omit tasks, also
// from their sequences (change.h). `before`: if `instance` is itself a remainder, its
// `ends_with_plan`; otherwise empty.
//
// With `rests` = kWhereItMust, each plan of the remainder continues the executed steps to a valid
// plan of `instance`. For this purpose an agent without a destination that has visited all its
// tasks does not become idle. Its destination is a place where it may rest in `instance`, if
// possible its last place in `plan`. Throws InstanceError if two agents would have the same
// destination. Precondition for kWhereItMust: `instance` has no choices.
Remainder advance(const Instance& instance, const Plan& plan, Time time,
                  Rests rests = Rests::kAnywhere, const std::vector<bool>& before = {});

// Copies of `instance` in which the agents that are marked in `agents` have no destination, or have
// the last places of their paths in `plan` as destinations.
Instance without_ends_of_plan(const Instance& instance, const std::vector<bool>& agents);
Instance with_ends_of_plan(const Instance& instance, const Plan& plan,
                           const std::vector<bool>& agents);

// The finish time of the first `time` steps of an agent's plan, counting only task executions that
// are completed by then.
Time finish_of_steps(const AgentPlan& plan, Time time);

// Returns the plan of `instance` that consists of the first `time` steps of `plan` and then of
// `rest`. Precondition: `rest` is a valid plan of `later`, which is the instance in the result of
// advance(instance, plan, time). `instance` has no choices.
Plan joined(const Instance& instance, const Plan& plan, Time time, const Instance& later,
            const Plan& rest);

}  // namespace grove::detail
