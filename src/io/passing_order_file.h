// SPDX-License-Identifier: MIT
// Formats action dependency graphs as passing order files (docs/passing-order.md).
#pragma once

#include <string>

#include "execution/action_dependency_graph.h"
#include "io/frame.h"
#include "model/instance.h"

namespace grove::detail {

// Returns a JSON object with the actions of each robot, their positions in the world frame, and
// their dependencies.
std::string passing_order_text(const Instance& instance, const ActionDependencyGraph& order,
                               const Frame& frame);

}  // namespace grove::detail
