// SPDX-License-Identifier: MIT
// Simulates an execution with a switchable action dependency graph (Berndt, van Duijkeren,
// Palmieri, Kleiner and Keviczky, 2024), in which robots change their passing order if a late robot
// delays others.
#pragma once

#include <cstdint>
#include <vector>

#include "execution/execution_trace.h"

namespace grove::detail {

struct SwitchableTrace {
  ExecutionTrace trace;
  std::int64_t switches = 0;  // number of changes of two robots' order on a place
  // The robots that did not complete their actions, in order of AgentIndex.
  std::vector<BlockedRobot> blocked_robots;
};

// Simulates the execution as simulate() does, but robots can change their order. A robot that has
// waited for another robot for `patience` >= 1 steps attempts to pass first, on the place for which
// it waits and on all places around it that both robots pass consecutively. The attempt succeeds if
// the other robot has not begun to enter any of these places, the robot itself does not rest on any
// of them, no robots would wait in a cycle, and the expected sum of finish times decreases. After a
// failure the robot waits twice as long before the next attempt. Robots do not attempt to pass in a
// ring. The expectation assumes that actions take as long as in the plan, and that an action that
// is overdue by d steps takes max(d, 1) more steps. Robots never wait in a cycle and never collide;
// proof: switching.cpp. `order` must be the action dependency graph of `plan`. O(actions * (agents
// + log actions)), plus O(actions) for each attempt.
SwitchableTrace simulate_switchable(const World& world, const Plan& plan,
                                    const ActionDependencyGraph& order, const Duration& duration,
                                    Time patience = 5);

}  // namespace grove::detail
