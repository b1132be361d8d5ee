// SPDX-License-Identifier: MIT
// Robots that change who goes first, where a late one holds others up (switchable action dependency
// graph: Berndt, van Duijkeren, Palmieri, Kleiner and Keviczky, 2024).
#pragma once

#include <cstdint>
#include <vector>

#include "execution/execution_trace.h"

namespace grove::detail {

struct SwitchableTrace {
  ExecutionTrace drive;
  std::int64_t switches = 0;        // places at which a robot let another one go first after all
  std::vector<BlockedRobot> stuck;  // who waits for whom at the end
};

// As drive(), but a robot that has waited for another for `patience` >= 1 steps, and ever longer if
// that is of no use, goes first where they meet next - on all places that they pass one after the
// other - if the sum of finish times is then expected to be less: of what is not known yet it is
// expected that actions take as long as in the plan, and one that is overdue as long again as it is
// overdue. Nobody ever waits in a circle, and nobody collides: switching.cpp. `plan` is that of
// `order`. O(actions log actions), and O(actions) for each switch that is considered.
SwitchableTrace simulate_switchable(const World& world, const Plan& plan,
                                    const ActionDependencyGraph& order, const Duration& duration,
                                    Time patience = 5);

}  // namespace grove::detail
