// SPDX-License-Identifier: MIT
// Writes action dependency graphs as files (docs/passing-order.md).
#pragma once

#include <string>

#include "execution/action_dependency_graph.h"
#include "io/frame.h"
#include "model/instance.h"

namespace grove::detail {

// One JSON object with the actions of each robot, their positions, and their dependencies.
std::string passing_order_text(const Instance& instance, const ActionDependencyGraph& order,
                               const Frame& frame);

}  // namespace grove::detail
