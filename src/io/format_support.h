// SPDX-License-Identifier: MIT
// What the files of other tools can hold of an instance. Their writers have one rule: what is read
// back is the instance that was written, or they throw NotRepresentable. Only the order of the
// agents of a task, which means nothing, is not kept, nor the letters with which a map file names
// terrain.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "model/instance.h"

namespace grove::detail {

// What can be given up so that a format holds the rest.
enum class Loss : std::uint8_t { kNothing, kIds, kTasks };

// The format cannot hold this instance. field() is "agents/3" or "tasks/0"; what() says what it is
// about them and what was expected.
class NotRepresentable : public InstanceError {
 public:
  NotRepresentable(std::string field, const std::string& message, Loss loss)
      : InstanceError(std::move(field), message), loss_(loss) {}
  // Giving this up would help; kNothing: nothing would.
  Loss loss() const { return loss_; }

 private:
  Loss loss_;
};

// The ids that readers give where a file has none: agents a0, a1, ... in order; tasks t0, t1, ...
// as they appear first when the agents are asked one after the other for theirs.
std::string default_agent_id(AgentIndex agent);
std::string default_task_id(TaskIndex task);

// These throw NotRepresentable unless `instance` is as their names say. `format` is named in
// what(). A grid, agents that turn freely, tasks that take no time.
void require_free_grid(const Instance& instance, std::string_view format);
// No idle agents.
void require_work_for_all(const Instance& instance, std::string_view format);
// No two tasks on one cell.
void require_distinct_cells(const Instance& instance, std::string_view format);
void require_goals(const Instance& instance, std::string_view format);
void require_no_tasks(const Instance& instance, std::string_view format);
void require_default_agent_ids(const Instance& instance, std::string_view format);
// The order of the tasks is the default one then, too.
void require_default_task_ids(const Instance& instance, std::string_view format);

// `instance` with less to express. without_tasks() throws InstanceError (field "agents/<i>") when
// an agent has no destination: it would have nothing left to do.
Instance without_tasks(const Instance& instance);
Instance with_default_task_ids(const Instance& instance);
Instance with_default_agent_ids(const Instance& instance);

}  // namespace grove::detail
