// SPDX-License-Identifier: MIT
#include "grove/model/instance.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace grove {
namespace {

void require_new_id(const std::string& id, bool is_new) {
  if (id.empty()) throw InstanceError("id", "expected an id that is not empty");
  if (!is_new)
    throw InstanceError("id", fmt::format("id '{}' is used twice; expected distinct ids", id));
}

}  // namespace

Instance::Instance(Map map)
    : map_(std::make_shared<const Map>(std::move(map))),
      world_(std::visit([](const auto& m) -> const World* { return &m; }, *map_)) {}

InstanceBuilder::InstanceBuilder(Map map) : instance_(std::move(map)) {}

std::string InstanceBuilder::name(Place place) const {
  return (instance_.is_on_grid() ? "cell " : "place ") + instance_.world().name(place);
}

Cell InstanceBuilder::passable_cell(const std::string& field, Position p) const {
  const Grid& grid = instance_.grid();
  if (!grid.contains(p))
    throw InstanceError(
        field, fmt::format("cell [{}, {}] is outside the map; expected [x, y] (column, row) "
                           "with x in 0..{} and y in 0..{}",
                           p.x, p.y, grid.width() - 1, grid.height() - 1));
  if (!grid.passable(grid.cell(p)))
    throw InstanceError(
        field,
        fmt::format("cell [{}, {}] is blocked on the map; expected a passable cell", p.x, p.y));
  return grid.cell(p);
}

AgentIndex InstanceBuilder::add_agent(std::string id, Position start,
                                      std::optional<Position> goal) {
  require_new_id(id, !agent_by_id_.contains(id));
  const Cell from = passable_cell("start", start);
  const auto to = goal ? std::optional(passable_cell("goal", *goal)) : std::nullopt;
  return add_agent(std::move(id), from, to);
}

AgentIndex InstanceBuilder::add_agent(std::string id, State start, std::optional<Place> goal) {
  require_new_id(id, !agent_by_id_.contains(id));
  Agent agent{std::move(id), start, goal, {}};
  const Place from = instance_.world().place(start);
  if (const auto it = agent_by_start_.find(from); it != agent_by_start_.end())
    throw InstanceError(
        "start", fmt::format("{} is already the start of agent '{}'; expected distinct starts",
                             name(from), instance_.agent(it->second).id));
  if (goal) {
    if (const auto it = agent_by_goal_.find(*goal); it != agent_by_goal_.end())
      throw InstanceError(
          "goal", fmt::format("{} is already the goal of agent '{}'; expected distinct goals",
                              name(*goal), instance_.agent(it->second).id));
  }

  const auto index = static_cast<AgentIndex>(instance_.agents_.size());
  agent_by_id_.emplace(agent.id, index);
  agent_by_start_.emplace(from, index);
  if (agent.goal) agent_by_goal_.emplace(*agent.goal, index);
  instance_.agents_.push_back(std::move(agent));
  return index;
}

TaskIndex InstanceBuilder::add_task(std::string id, Position cell,
                                    std::span<const std::string> agent_ids) {
  require_new_id(id, !task_by_id_.contains(id));
  const Cell place = passable_cell("cell", cell);
  return add_task(std::move(id), place, agent_ids);
}

TaskIndex InstanceBuilder::add_task(std::string id, Place place,
                                    std::span<const std::string> agent_ids) {
  require_new_id(id, !task_by_id_.contains(id));
  Task task{std::move(id), place, {}};
  if (const auto it = task_by_place_.find(place); it != task_by_place_.end())
    throw InstanceError("cell", fmt::format("{} is already task '{}'; expected one task per {}, "
                                            "with all its agents",
                                            name(place), instance_.task(it->second).id,
                                            instance_.is_on_grid() ? "cell" : "place"));
  if (agent_ids.empty()) throw InstanceError("agents", "expected at least one agent");

  for (std::size_t k = 0; k < agent_ids.size(); ++k) {
    const std::string field = fmt::format("agents/{}", k);
    const auto it = agent_by_id_.find(agent_ids[k]);
    if (it == agent_by_id_.end())
      throw InstanceError(
          field, fmt::format("there is no agent '{}'; expected the id of an agent of this instance",
                             agent_ids[k]));
    if (std::ranges::find(task.agents, it->second) != task.agents.end())
      throw InstanceError(
          field, fmt::format("agent '{}' is listed twice; expected each agent once", agent_ids[k]));
    if (instance_.agent(it->second).tasks.size() >= kMaxTasksPerAgent)
      throw InstanceError(
          field, fmt::format("agent '{}' has more than {} tasks; expected at most {}", agent_ids[k],
                             kMaxTasksPerAgent, kMaxTasksPerAgent));
    task.agents.push_back(it->second);
  }

  const auto index = static_cast<TaskIndex>(instance_.tasks_.size());
  for (AgentIndex agent : task.agents) instance_.agents_[agent].tasks.push_back(index);
  task_by_id_.emplace(task.id, index);
  task_by_place_.emplace(task.cell, index);
  instance_.tasks_.push_back(std::move(task));
  return index;
}

Instance InstanceBuilder::build() && {
  if (instance_.agents_.empty()) throw InstanceError("agents", "expected at least one agent");
  for (std::size_t i = 0; i < instance_.agents_.size(); ++i) {
    const Agent& agent = instance_.agents_[i];
    if (!agent.goal && agent.tasks.empty())
      throw InstanceError(
          fmt::format("agents/{}", i),
          fmt::format("agent '{}' has neither a goal nor a task; expected one of them", agent.id));
  }
  return std::move(instance_);
}

}  // namespace grove
