// SPDX-License-Identifier: MIT
// Data of the page for an execution (README.md in this directory): the log and the passing order.
#pragma once

#include <string>

#include "execution/action_dependency_graph.h"
#include "io/execution_log_file.h"
#include "model/instance.h"

namespace grove::detail {

// Returns a JSON object: per robot, the samples of its pose, in columns.
std::string drive_data(const ExecutionLog& log);

// Returns a JSON object: per robot, when its actions end in the plan, which tasks they visit, and
// which actions they wait for.
std::string order_data(const Instance& instance, const ActionDependencyGraph& order);

}  // namespace grove::detail
