// SPDX-License-Identifier: MIT
// Collision test for execution traces. Uses only the definition of a collision, not the passing
// order.
#pragma once

#include <string>
#include <vector>

#include "execution/execution_trace.h"

namespace grove::detail::testing {

// Describes a collision in the trace; returns an empty string if there is none. A robot occupies
// its place until its move away ends, and the next place from the start of that move. Two robots
// that occupy a place at the same time collide, with one exception: a robot may enter a place while
// another leaves it if both moves start and end at the same times, as in one step of a plan, and
// the two robots do not swap. Actions that never start are ignored.
std::string collision(const World& world, const ActionDependencyGraph& order,
                      const ExecutionTrace& trace, const std::vector<State>& starts);

}  // namespace grove::detail::testing
