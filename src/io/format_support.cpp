// SPDX-License-Identifier: MIT
#include "io/format_support.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <vector>

namespace grove::detail {
namespace {

std::string agent_field(AgentIndex agent) {
  return fmt::format("agents/{}", agent);
}

std::string task_field(TaskIndex task) {
  return fmt::format("tasks/{}", task);
}

// Returns the tasks in the order of their first appearance in the agents' lists, agent by agent.
// Precondition: agents must visit all their tasks.
std::vector<TaskIndex> order_of_appearance(const Instance& instance) {
  std::vector<TaskIndex> order;
  std::vector<bool> seen(instance.task_count());
  for (const Agent& agent : instance.agents()) {
    for (TaskIndex task : agent.tasks) {
      if (seen[task]) continue;
      seen[task] = true;
      order.push_back(task);
    }
  }
  return order;
}

// Returns a builder with the map, rules and agents of `instance`, where agent i has the id
// agent_id(i). A task execution in progress names its task t as task_id(t); it is omitted if this
// is empty.
template <typename AgentId, typename TaskId>
InstanceBuilder with_agents(const Instance& instance, AgentId agent_id, TaskId task_id) {
  InstanceBuilder builder = InstanceBuilder::like(instance);
  for (AgentIndex i = 0; i < instance.agent_count(); ++i) {
    AgentSpec spec = instance.spec(i);
    spec.id = agent_id(i);
    if (spec.working) {
      const TaskIndex task = instance.world().work(instance.agent(i).start).task;
      const std::string id = task_id(task);
      spec.working = id.empty() ? std::nullopt : std::optional(WorkBegun{id, spec.working->done});
    }
    builder.add_agent(std::move(spec));
  }
  return builder;
}

template <typename AgentId>
void add_task(InstanceBuilder& builder, const Task& task, std::string id, AgentId agent_id) {
  std::vector<std::string> agents;
  for (AgentIndex agent : task.agents) agents.push_back(agent_id(agent));
  builder.add_task(std::move(id), task.cell, agents, task.duration, task.need);
}

}  // namespace

std::string default_agent_id(AgentIndex agent) {
  return fmt::format("a{}", agent);
}

std::string default_task_id(TaskIndex task) {
  return fmt::format("t{}", task);
}

NotRepresentable not_representable(const Choice& choice, std::string_view format,
                                   std::string_view remedy) {
  return {choice.field,
          refusal_text(choice, fmt::format("cannot be represented in {}", format), remedy),
          Loss::kNothing};
}

void require_free_grid(const Instance& instance, std::string_view format) {
  if (!instance.is_on_grid())
    throw NotRepresentable(
        "roadmap", fmt::format("a roadmap cannot be represented in {}; expected a grid", format),
        Loss::kNothing);
  for (AgentIndex i = 0; i < instance.agent_count(); ++i)
    if (instance.agent(i).motion.turn_steps > 0)
      throw NotRepresentable(
          agent_field(i),
          fmt::format("agent '{}' turns, which cannot be represented in {}; expected "
                      "agents that turn freely",
                      instance.agent(i).id, format),
          Loss::kNothing);
  for (TaskIndex i = 0; i < instance.task_count(); ++i)
    if (instance.task(i).duration > 0)
      throw NotRepresentable(task_field(i),
                             fmt::format("task '{}' takes time, which cannot be represented in {}; "
                                         "expected tasks without a duration",
                                         instance.task(i).id, format),
                             Loss::kNothing);
}

void require_fixed_tasks(const Instance& instance, std::string_view format) {
  for (TaskIndex i = 0; i < instance.task_count(); ++i) {
    const Task& task = instance.task(i);
    if (!task.needs_all()) throw not_representable(choice_of_agents(instance, i), format);
  }
}

void require_work_for_all(const Instance& instance, std::string_view format) {
  for (AgentIndex i = 0; i < instance.agent_count(); ++i)
    if (instance.agent(i).is_idle())
      throw NotRepresentable(agent_field(i),
                             fmt::format("agent '{}' has neither a goal nor a task, which cannot "
                                         "be represented in {}; expected one of them",
                                         instance.agent(i).id, format),
                             Loss::kNothing);
}

void require_distinct_cells(const Instance& instance, std::string_view format) {
  std::map<Place, TaskIndex> by_cell;
  for (TaskIndex i = 0; i < instance.task_count(); ++i) {
    const auto [first, is_new] = by_cell.emplace(instance.task(i).cell, i);
    if (!is_new)
      throw NotRepresentable(
          task_field(i),
          fmt::format("task '{}' is on the cell of task '{}', which cannot be represented in {}; "
                      "expected one task per cell",
                      instance.task(i).id, instance.task(first->second).id, format),
          Loss::kNothing);
  }
}

void require_goals(const Instance& instance, std::string_view format) {
  for (AgentIndex i = 0; i < instance.agent_count(); ++i) {
    const Agent& agent = instance.agent(i);
    if (!agent.goals.empty()) throw not_representable(choice_of_goals(instance, i), format);
    if (!agent.goal)
      throw NotRepresentable(
          agent_field(i),
          fmt::format(
              "agent '{}' has no goal; expected one for every agent, because {} requires it",
              agent.id, format),
          Loss::kNothing);
  }
}

void require_no_tasks(const Instance& instance, std::string_view format) {
  if (instance.task_count() == 0) return;
  throw NotRepresentable("tasks/0",
                         fmt::format("task '{}' cannot be represented in {}; expected no tasks",
                                     instance.task(0).id, format),
                         Loss::kTasks);
}

void require_default_agent_ids(const Instance& instance, std::string_view format) {
  for (AgentIndex i = 0; i < instance.agent_count(); ++i)
    if (instance.agent(i).id != default_agent_id(i))
      throw NotRepresentable(
          agent_field(i),
          fmt::format("{} has no ids: read back, agent '{}' would be '{}'; expected this id",
                      format, instance.agent(i).id, default_agent_id(i)),
          Loss::kIds);
}

void require_default_task_ids(const Instance& instance, std::string_view format) {
  require_fixed_tasks(instance, format);
  const std::vector<TaskIndex> order = order_of_appearance(instance);
  for (TaskIndex i = 0; i < instance.task_count(); ++i) {
    const std::string& id = instance.task(order[i]).id;
    if (id != default_task_id(i) || order[i] != i)
      throw NotRepresentable(
          fmt::format("tasks/{}", order[i]),
          fmt::format("{} has no ids of tasks: read back, task '{}' (number {}) would be '{}' "
                      "(number {}); expected that",
                      format, id, order[i], default_task_id(i), i),
          Loss::kIds);
  }
}

Instance without_tasks(const Instance& instance) {
  for (AgentIndex i = 0; i < instance.agent_count(); ++i)
    if (!instance.agent(i).has_destination())
      throw InstanceError(agent_field(i),
                          fmt::format("agent '{}' has no goal; expected one for every agent, "
                                      "because without tasks it would have nothing to do",
                                      instance.agent(i).id));
  return with_agents(
             instance, [&](AgentIndex i) { return instance.agent(i).id; },
             [](TaskIndex) { return std::string(); })
      .build();
}

Instance with_default_task_ids(const Instance& instance) {
  if (!std::ranges::all_of(instance.tasks(), &Task::needs_all)) return instance;
  const auto agent_id = [&](AgentIndex i) { return instance.agent(i).id; };
  const std::vector<TaskIndex> order = order_of_appearance(instance);
  InstanceBuilder builder = with_agents(instance, agent_id, [&](TaskIndex task) {
    return default_task_id(static_cast<TaskIndex>(std::ranges::find(order, task) - order.begin()));
  });
  TaskIndex count = 0;
  for (TaskIndex task : order)
    add_task(builder, instance.task(task), default_task_id(count++), agent_id);
  return std::move(builder).build();
}

Instance with_default_agent_ids(const Instance& instance) {
  InstanceBuilder builder =
      with_agents(instance, default_agent_id, [&](TaskIndex i) { return instance.task(i).id; });
  for (const Task& task : instance.tasks()) add_task(builder, task, task.id, default_agent_id);
  return std::move(builder).build();
}

}  // namespace grove::detail
