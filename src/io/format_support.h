// SPDX-License-Identifier: MIT
// Checks whether a file format of another tool can represent an instance. Every writer either
// writes a file from which the reader restores the instance, or throws NotRepresentable. Only two
// things need not be preserved: the order of the agents of a task, which has no meaning, and the
// characters for types of terrain in a map file.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "model/choices.h"
#include "model/instance.h"

namespace grove::detail {

// The part of an instance that must be removed so that a format can represent the rest.
enum class Loss : std::uint8_t { kNothing, kIds, kTasks };

// Thrown if a format cannot represent the instance. field() is the position of the cause, such as
// "agents/3" or "tasks/0". what() states the cause and what was expected.
class NotRepresentable : public InstanceError {
 public:
  NotRepresentable(std::string field, const std::string& message, Loss loss)
      : InstanceError(std::move(field), message), loss_(loss) {}
  // The format can represent the instance after this part is removed. kNothing: there is no such
  // part.
  Loss loss() const { return loss_; }

 private:
  Loss loss_;
};

// The exception for a choice; its text is refusal_text().
NotRepresentable not_representable(const Choice& choice, std::string_view format,
                                   std::string_view remedy = "");

// The ids that readers assign if a format has none: a0, a1, ... for agents in order, and t0, t1,
// ... for tasks in the order of their first appearance in the agents' lists, agent by agent.
std::string default_agent_id(AgentIndex agent);
std::string default_task_id(TaskIndex task);

// The functions require_...() throw NotRepresentable unless `instance` has the property in their
// name. what() names `format`. require_free_grid() requires a grid, agents that turn freely, and
// tasks that take no time.
void require_free_grid(const Instance& instance, std::string_view format);
// Requires that each agent of a task must visit it.
void require_fixed_tasks(const Instance& instance, std::string_view format);
// Requires that no agent is idle.
void require_work_for_all(const Instance& instance, std::string_view format);
// Requires that no two tasks are on the same cell.
void require_distinct_cells(const Instance& instance, std::string_view format);
// Requires that each agent has a destination, and no choice of it.
void require_goals(const Instance& instance, std::string_view format);
void require_no_tasks(const Instance& instance, std::string_view format);
void require_default_agent_ids(const Instance& instance, std::string_view format);
// Also requires that the tasks are in the order of their default ids, and require_fixed_tasks().
void require_default_task_ids(const Instance& instance, std::string_view format);

// Copies of `instance` without its tasks, or with default ids. without_tasks() throws InstanceError
// (field "agents/<i>") if an agent has no destination, because it would have nothing left to do.
// with_default_task_ids() also puts the tasks in the order of their default ids. It returns an
// instance unchanged in which a task needs only some of its agents, because no format without ids
// can represent it.
Instance without_tasks(const Instance& instance);
Instance with_default_task_ids(const Instance& instance);
Instance with_default_agent_ids(const Instance& instance);

}  // namespace grove::detail
