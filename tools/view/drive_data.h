// SPDX-License-Identifier: MIT
// Data of the page of an execution (README.md in this directory): the log and the passing order.
#pragma once

#include <string>

#include "execution/action_dependency_graph.h"
#include "io/execution_log_file.h"
#include "model/instance.h"

namespace grove::detail {

// Returns a JSON object with the header of the log and, for each robot, its pose samples as columns
// of differences.
std::string drive_data(const ExecutionLog& log);

// Returns a JSON object with, for each robot, the planned ends of its actions, the tasks that they
// visit, and the actions of other robots that they wait for.
std::string order_data(const Instance& instance, const ActionDependencyGraph& order);

}  // namespace grove::detail
