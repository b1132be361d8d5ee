// SPDX-License-Identifier: MIT
// Computes the valid plan that results from delays of some robots.
#pragma once

#include <span>
#include <stdexcept>
#include <string>

#include "execution/execution_trace.h"

namespace grove::detail {

// The robot is `steps` time steps behind the plan.
struct Delay {
  AgentIndex agent = -1;
  Time steps = 0;
};

// Thrown for an impossible delay: the robot would be at a time before its start, or it would have
// begun an action that it cannot have begun, because another late robot is in its way. Also thrown
// if a robot is named twice.
class InfeasibleDelay : public std::invalid_argument {
 public:
  InfeasibleDelay(AgentIndex agent, const std::string& message)
      : std::invalid_argument(message), agent_(agent) {}
  AgentIndex agent() const { return agent_; }

 private:
  AgentIndex agent_;
};

// Returns the valid plan of `instance` that results from `plan` if the robots in `late` are late at
// `time` >= 0. Precondition: `plan` is valid, and `order` is its action dependency graph. At `time`
// each robot in `late` is in the pose that `plan` has `steps` steps earlier. Every other robot is
// as far as the dependencies permit, on time if possible. From `time` on, every action begins as
// soon as its dependencies permit, so the result does not contain the unnecessary waits of `plan`.
//
// As in every plan, a robot can enter a place in the step in which another robot leaves it or, if
// Instance::may_follow() is false, in the next step at the earliest. If `late` is empty, the result
// is equal to `plan` up to `time`. There is one exception to validity: if a late robot starts at
// work, the WorkTime of that task execution is moved by the delay, as advance() requires, whereas
// in a valid plan the execution continues at time 0. Throws InfeasibleDelay.
Plan delayed_plan(const Instance& instance, const Plan& plan, const ActionDependencyGraph& order,
                  Time time, std::span<const Delay> late);

}  // namespace grove::detail
