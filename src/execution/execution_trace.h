// SPDX-License-Identifier: MIT
// Robots that drive a plan along its passing order, each action as soon as it may begin.
#pragma once

#include <functional>
#include <vector>

#include "execution/action_dependency_graph.h"

namespace grove::detail {

// When each action was begun and completed, by ActionIndex; kNever: it was not.
struct ExecutionTrace {
  std::vector<Time> begin;
  std::vector<Time> end;

  // When the robot had done everything; kNever: it never has.
  Time finish(const ActionDependencyGraph& order, AgentIndex agent) const {
    return order.begin_of(agent) == order.end_of(agent) ? 0 : end[order.end_of(agent) - 1];
  }
};

// How long an action takes from its begin on, at least as long as the plan has it; kNever: the
// robot does not move again. Called once for each action that begins, in the order of steps.
using Duration = std::function<Time(ActionIndex action, Time begin)>;

// When an action ends that begins then and takes so long; kNever: never. Throws
// std::overflow_error for times that no plan can mention.
Time end_of_action(Time begin, Time duration);

// O(actions). The moves of a ring take as long as the slowest of them. Throws std::overflow_error
// for times that no plan can mention.
ExecutionTrace drive(const ActionDependencyGraph& order, const Duration& duration);
// As long as the plan has it.
ExecutionTrace simulate_nominal(const ActionDependencyGraph& order);

// The plan that was driven: an action that takes longer than it must is a wait before it. If
// everybody has done everything a valid plan of `instance`; else of what was done.
Plan executed_plan(const Instance& instance, const Plan& plan, const ActionDependencyGraph& order,
                   const ExecutionTrace& drive);

// A robot that waits for ever, and for whom; for itself if it does not move again.
struct BlockedRobot {
  AgentIndex agent = -1;
  AgentIndex waits_for = -1;
};
// All that have not done everything.
std::vector<BlockedRobot> stuck(const ActionDependencyGraph& order, const ExecutionTrace& drive);

}  // namespace grove::detail
