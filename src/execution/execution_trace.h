// SPDX-License-Identifier: MIT
// Simulates the execution of a plan under its action dependency graph, where each action begins as
// soon as its dependencies permit.
#pragma once

#include <functional>
#include <vector>

#include "execution/action_dependency_graph.h"

namespace grove::detail {

// The start and completion time of each action, by ActionIndex; kNever if the action was not begun
// or not completed.
struct ExecutionTrace {
  std::vector<Time> begin;
  std::vector<Time> end;

  // The completion time of the robot's last action; 0 if it has no actions, kNever if the last one
  // is not completed.
  Time finish(const ActionDependencyGraph& order, AgentIndex agent) const {
    return order.begin_of(agent) == order.end_of(agent) ? 0 : end[order.end_of(agent) - 1];
  }
};

// Returns the duration of an action that begins at `begin`, in time steps: at least its duration in
// the plan, or kNever if the robot never completes the action. It is called once for each action
// that begins.
using Duration = std::function<Time(ActionIndex action, Time begin)>;

// Returns begin + duration; kNever if `duration` is kNever. Throws std::overflow_error if the sum
// is kNever or more.
Time end_of_action(Time begin, Time duration);

// Simulates the execution. All moves of a ring take as long as the slowest of them. Calls
// `duration` in the order of the steps of `order`. O(actions). Throws std::overflow_error if a
// finite time would reach kNever.
ExecutionTrace simulate(const ActionDependencyGraph& order, const Duration& duration);
// Simulates the execution without delays: every action takes as long as in the plan.
ExecutionTrace simulate_nominal(const ActionDependencyGraph& order);

// Returns the plan as executed. An action that took longer than in `plan` is preceded by a wait for
// the extra time; a task execution that is in progress at the start is followed by it. If all
// robots completed all actions, the result is a valid plan of `instance`; otherwise it contains
// only the completed actions.
Plan executed_plan(const Instance& instance, const Plan& plan, const ActionDependencyGraph& order,
                   const ExecutionTrace& trace);

// A robot that does not complete its actions, and the robot for which it waits. A robot that does
// not complete an action that it has begun waits for itself; in a ring, all robots wait for the
// same one.
struct BlockedRobot {
  AgentIndex agent = -1;
  AgentIndex waits_for = -1;
};
// Returns all robots that did not complete all their actions, in the order of the steps that
// contain their first incomplete actions.
std::vector<BlockedRobot> blocked_robots(const ActionDependencyGraph& order,
                                         const ExecutionTrace& trace);

}  // namespace grove::detail
