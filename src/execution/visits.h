// SPDX-License-Identifier: MIT
// The tasks that the actions of an action dependency graph visit.
#pragma once

#include <vector>

#include "execution/action_dependency_graph.h"
#include "model/instance.h"

namespace grove::detail {

// The visit is made when `action` is completed; kNoAction: at the start.
struct TaskVisit {
  TaskIndex task = -1;
  ActionIndex action = kNoAction;
};

// Returns the visits by agent, in the order of its actions. A task without duration is visited when
// the agent first is on its place; other tasks when their work is done. Tasks that `order` does not
// visit are omitted.
std::vector<std::vector<TaskVisit>> task_visits(const Instance& instance,
                                                const ActionDependencyGraph& order);

}  // namespace grove::detail
