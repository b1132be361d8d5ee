// SPDX-License-Identifier: MIT
// The parts of an instance that file formats of other tools can represent. Rule for writers: either
// reading the file back yields the instance that was written, or the writer throws
// NotRepresentable. Two things need not be preserved: the order of the agents of a task, which has
// no meaning, and the letters with which a map file names terrain.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "model/instance.h"

namespace grove::detail {

// What must be removed from the instance so that a format can represent the rest.
enum class Loss : std::uint8_t { kNothing, kIds, kTasks };

// Thrown if a format cannot represent the instance. field() is "agents/3" or "tasks/0". what()
// describes the problem and what was expected.
class NotRepresentable : public InstanceError {
 public:
  NotRepresentable(std::string field, const std::string& message, Loss loss)
      : InstanceError(std::move(field), message), loss_(loss) {}
  // The format can represent the instance without this; kNothing: it cannot.
  Loss loss() const { return loss_; }

 private:
  Loss loss_;
};

// The ids that readers assign if a file has none: agents a0, a1, ... in order; tasks t0, t1, ... in
// the order of their first appearance, agent by agent.
std::string default_agent_id(AgentIndex agent);
std::string default_task_id(TaskIndex task);

// Each of these functions throws NotRepresentable unless `instance` has the property in its name.
// `format` is named in what(). require_free_grid(): a grid, agents that turn freely, and tasks that
// take no time.
void require_free_grid(const Instance& instance, std::string_view format);
// There are no idle agents.
void require_work_for_all(const Instance& instance, std::string_view format);
// No two tasks are on the same cell.
void require_distinct_cells(const Instance& instance, std::string_view format);
void require_goals(const Instance& instance, std::string_view format);
void require_no_tasks(const Instance& instance, std::string_view format);
void require_default_agent_ids(const Instance& instance, std::string_view format);
// This also requires the default order of the tasks.
void require_default_task_ids(const Instance& instance, std::string_view format);

// Copies of `instance` without a property. without_tasks() throws InstanceError (field
// "agents/<i>") if an agent has no destination, because it would have nothing left to do.
Instance without_tasks(const Instance& instance);
Instance with_default_task_ids(const Instance& instance);
Instance with_default_agent_ids(const Instance& instance);

}  // namespace grove::detail
