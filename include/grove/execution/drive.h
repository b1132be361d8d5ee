// SPDX-License-Identifier: MIT
// Robots that drive a plan along its passing order, each action as soon as it may begin.
#pragma once

#include <functional>
#include <limits>
#include <vector>

#include "grove/execution/passing_order.h"

namespace grove {

// Times in steps, no longer whole ones.
inline constexpr double kNeverDone = std::numeric_limits<double>::infinity();

// When each action was begun and completed, by ActionIndex; kNeverDone: it was not.
struct Drive {
  std::vector<double> begin;
  std::vector<double> end;

  // When the robot had done everything; kNeverDone: it never has.
  double finish(const PassingOrder& order, AgentIndex agent) const {
    return order.begin_of(agent) == order.end_of(agent) ? 0 : end[order.end_of(agent) - 1];
  }
};

// How long an action takes from its begin on, in steps; kNeverDone: the robot does not move again.
// Called once for each action that begins, in the order of steps.
using Duration = std::function<double(ActionIndex action, double begin)>;

// O(actions). The moves of a ring take as long as the slowest of them.
Drive drive(const PassingOrder& order, const Duration& duration);
// As long as the plan has it.
Drive drive_undisturbed(const PassingOrder& order);

// A robot that waits for ever, and for whom; for itself if it does not move again.
struct Stuck {
  AgentIndex agent = -1;
  AgentIndex waits_for = -1;
};
// All that have not done everything.
std::vector<Stuck> stuck(const PassingOrder& order, const Drive& drive);

}  // namespace grove
