// SPDX-License-Identifier: MIT
// Collision test for execution traces, from the definition of a collision only, not from the
// passing order.
#pragma once

#include <string>
#include <vector>

#include "execution/execution_trace.h"

namespace grove::detail::testing {

// Describes a collision in the trace; empty if there is none. A robot is on its place until its
// move away from it ends, and on the next place from the beginning of that move. Two robots on one
// place at one time collide. Exception: one may enter a place exactly while the other leaves it, if
// both moves begin and end together, as in one step of a plan, and the two do not swap. Actions
// that are never begun are ignored.
std::string collision(const World& world, const ActionDependencyGraph& order,
                      const ExecutionTrace& trace, const std::vector<State>& starts);

}  // namespace grove::detail::testing
