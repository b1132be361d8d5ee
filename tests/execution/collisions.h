// SPDX-License-Identifier: MIT
// Do robots collide that drive like this? Written from what robots are, not from the passing order.
#pragma once

#include <string>
#include <vector>

#include "execution/execution_trace.h"

namespace grove::detail::testing {

// A robot is on its place until it has left it and on the next one from the begin of its move: two
// robots on one place at one time collide. But one may enter a place exactly while the other leaves
// it, both moves beginning and ending together, as in one step of a plan; unless they swap. Empty:
// nobody does; else what happens first, in words. Actions that are never begun do not happen.
std::string collision(const World& world, const ActionDependencyGraph& order,
                      const ExecutionTrace& drive, const std::vector<State>& starts);

}  // namespace grove::detail::testing
