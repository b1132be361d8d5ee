// SPDX-License-Identifier: MIT
// The valid plan that results when some robots are late.
#pragma once

#include <span>
#include <stdexcept>
#include <string>

#include "execution/execution_trace.h"

namespace grove::detail {

// The robot is `steps` steps behind the plan.
struct Delay {
  AgentIndex agent = -1;
  Time steps = 0;
};

// Thrown for a delay that is impossible: the robot would be at a time before its start, or another
// late robot would be in its way.
class InfeasibleDelay : public std::invalid_argument {
 public:
  InfeasibleDelay(AgentIndex agent, const std::string& message)
      : std::invalid_argument(message), agent_(agent) {}
  AgentIndex agent() const { return agent_; }

 private:
  AgentIndex agent_;
};

// Returns the valid plan of `instance` that results from `plan`, a valid plan with action
// dependency graph `order`, if the robots in `late` are late at `time` >= 0. At `time` each robot
// in `late` is where `plan` had it `steps` steps earlier. Every other robot is as far as `order`
// permits, on time if possible. From `time` on every action begins as soon as it may, so waits
// without a purpose are gone.
//
// Times are those of plans: a robot that follows another one enters a place in the step in which
// the other leaves it or, if Instance::may_follow() is false, in the next step. If `late` is empty,
// the result is equal to `plan` up to `time`. A late robot that starts at work continues this work
// later than a valid plan may: its WorkTime is moved by its delay, as advance() requires. Throws
// InfeasibleDelay.
Plan delayed_plan(const Instance& instance, const Plan& plan, const ActionDependencyGraph& order,
                  Time time, std::span<const Delay> late);

}  // namespace grove::detail
