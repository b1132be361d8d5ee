// SPDX-License-Identifier: MIT
// Simulates the execution of a plan by its action dependency graph: each action begins as soon as
// it may.
#pragma once

#include <functional>
#include <vector>

#include "execution/action_dependency_graph.h"

namespace grove::detail {

// Begin and completion time of each action, by ActionIndex; kNever: it was not begun or completed.
struct ExecutionTrace {
  std::vector<Time> begin;
  std::vector<Time> end;

  // The completion time of the robot's last action; kNever if it is not completed.
  Time finish(const ActionDependencyGraph& order, AgentIndex agent) const {
    return order.begin_of(agent) == order.end_of(agent) ? 0 : end[order.end_of(agent) - 1];
  }
};

// The duration of an action that begins at `begin`, at least its duration in the plan. kNever: the
// robot does not move again. Called once for each action that begins, in the order of steps.
using Duration = std::function<Time(ActionIndex action, Time begin)>;

// begin + duration; kNever if `duration` is kNever. Throws std::overflow_error if the sum is too
// large for a time of a plan.
Time end_of_action(Time begin, Time duration);

// Simulates the execution. The moves of a ring take as long as the slowest of them. O(actions).
// Throws std::overflow_error if a time is too large for a plan.
ExecutionTrace simulate(const ActionDependencyGraph& order, const Duration& duration);
// The same with the durations of the plan.
ExecutionTrace simulate_nominal(const ActionDependencyGraph& order);

// The plan as it was executed: if an action took longer than its duration in the plan, the
// difference is a wait before it. If all robots completed all actions, this is a valid plan of
// `instance`, else the plan of the completed actions.
Plan executed_plan(const Instance& instance, const Plan& plan, const ActionDependencyGraph& order,
                   const ExecutionTrace& trace);

// A robot that waits for ever, and the robot that it waits for; itself if it does not move again.
struct BlockedRobot {
  AgentIndex agent = -1;
  AgentIndex waits_for = -1;
};
// All robots that did not complete all their actions.
std::vector<BlockedRobot> blocked_robots(const ActionDependencyGraph& order,
                                         const ExecutionTrace& trace);

}  // namespace grove::detail
