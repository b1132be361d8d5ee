// SPDX-License-Identifier: MIT
// Passing orders as files (docs/passing-order.md).
#pragma once

#include <string>

#include "execution/action_dependency_graph.h"
#include "io/frame.h"
#include "model/instance.h"

namespace grove::detail {

// One JSON object: what each robot does, where in the world, and what each action waits for.
std::string passing_order_text(const Instance& instance, const ActionDependencyGraph& order,
                               const Frame& frame);

}  // namespace grove::detail
