// SPDX-License-Identifier: MIT
// Execution with a switchable action dependency graph (Berndt, van Duijkeren, Palmieri, Kleiner and
// Keviczky, 2024): robots change their passing order if a late robot delays others.
#pragma once

#include <cstdint>
#include <vector>

#include "execution/execution_trace.h"

namespace grove::detail {

struct SwitchableTrace {
  ExecutionTrace trace;
  std::int64_t switches = 0;  // places at which the passing order of two robots was changed
  std::vector<BlockedRobot> blocked_robots;  // at the end: robots that wait, and for whom
};

// As simulate(), but robots may switch their order. A robot that has waited for another one for
// `patience` >= 1 steps tries to pass first, on the next common place and on all places that both
// robots pass consecutively around it. If this fails, it waits twice as long before the next
// attempt. It passes first if this reduces the expected sum of finish times. The expectation
// assumes that actions take as long as in the plan, and that an action that is overdue by d steps
// takes d more steps. The robots never wait in a cycle and never collide: switching.cpp. `order`
// must be the graph of `plan`. O(actions log actions), plus O(actions) for each switch that is
// considered.
SwitchableTrace simulate_switchable(const World& world, const Plan& plan,
                                    const ActionDependencyGraph& order, const Duration& duration,
                                    Time patience = 5);

}  // namespace grove::detail
