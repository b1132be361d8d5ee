// SPDX-License-Identifier: MIT
// A drive as its page has it (README.md beside this): the log, and what the page has to know of the
// passing order.
#pragma once

#include <string>

#include "execution/action_dependency_graph.h"
#include "io/execution_log_file.h"
#include "model/instance.h"

namespace grove::detail {

// One JSON object: of each robot what was seen of it, in columns.
std::string drive_data(const ExecutionLog& log);

// One JSON object: of each robot when the plan has its actions end, which tasks they visit, and
// what they wait for.
std::string order_data(const Instance& instance, const ActionDependencyGraph& order);

}  // namespace grove::detail
