// SPDX-License-Identifier: MIT
// A plan as it is driven when some robots are late.
#pragma once

#include <span>
#include <stdexcept>
#include <string>

#include "execution/execution_trace.h"

namespace grove::detail {

// The robot is where the plan had it so many steps ago.
struct Late {
  AgentIndex agent = -1;
  Time steps = 0;
};

// A robot said to be where it cannot be: before its start, or where another one that is late is in
// its way.
class ImpossibleLateness : public std::invalid_argument {
 public:
  ImpossibleLateness(AgentIndex agent, const std::string& message)
      : std::invalid_argument(message), agent_(agent) {}
  AgentIndex agent() const { return agent_; }

 private:
  AgentIndex agent_;
};

// The valid plan of `instance` that comes of `plan`, a valid one with this passing order, when at
// `time` >= 0 the robots named stand where the plan had them earlier, and the others where the
// order then lets them be, on time if it does; from `time` on all go on as soon as they may, so the
// waits that serve nothing are gone. In steps as plans have them: who follows enters a place in the
// step in which the other leaves it, or, if Instance::may_follow() is false, in the next one. With
// no robot late it is `plan` up to `time`. A late robot that starts at work continues later than a
// valid plan may say: its WorkTime is moved by its lateness, which is what advance() needs. Throws
// ImpossibleLateness.
Plan late_plan(const Instance& instance, const Plan& plan, const ActionDependencyGraph& order,
               Time time, std::span<const Late> late);

}  // namespace grove::detail
