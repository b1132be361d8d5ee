// SPDX-License-Identifier: MIT
// Which actions of a passing order visit which tasks.
#pragma once

#include <vector>

#include "execution/action_dependency_graph.h"
#include "model/instance.h"

namespace grove::detail {

// Made when the action is completed; kNoAction: at the start.
struct TaskVisit {
  TaskIndex task = -1;
  ActionIndex action = kNoAction;
};

// By agent, in the order of the actions. A task without duration is visited when the agent first
// is on its place, others when the work is done. Tasks that the order does not visit are left out.
std::vector<std::vector<TaskVisit>> task_visits(const Instance& instance,
                                                const ActionDependencyGraph& order);

}  // namespace grove::detail
