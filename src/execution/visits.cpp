// SPDX-License-Identifier: MIT
#include "execution/visits.h"

#include <map>

namespace grove::detail {
namespace {

// By place: the agent's tasks without duration that are not visited yet.
using Open = std::multimap<Place, TaskIndex>;

std::vector<Open> open_tasks(const Instance& instance) {
  std::vector<Open> open(instance.agent_count());
  for (TaskIndex t = 0; t < instance.task_count(); ++t) {
    const Task& task = instance.task(t);
    if (task.duration > 0) continue;
    for (const AgentIndex agent : task.agents) open[agent].emplace(task.cell, t);
  }
  return open;
}

void come_by(Place place, ActionIndex action, Open& open, std::vector<TaskVisit>& visits) {
  const auto [begin, end] = open.equal_range(place);
  for (auto task = begin; task != end; ++task) visits.push_back({task->second, action});
  open.erase(begin, end);
}

}  // namespace

std::vector<std::vector<TaskVisit>> task_visits(const Instance& instance,
                                                const ActionDependencyGraph& order) {
  const World& world = instance.world();
  std::vector<Open> open = open_tasks(instance);
  std::vector<std::vector<TaskVisit>> visits(instance.agent_count());
  for (AgentIndex agent = 0; agent < instance.agent_count(); ++agent) {
    come_by(world.place(instance.agent(agent).start), kNoAction, open[agent], visits[agent]);
    for (ActionIndex a = order.begin_of(agent); a < order.end_of(agent); ++a) {
      const Action& action = order.actions()[a];
      if (action.kind == Action::Kind::kWork) visits[agent].push_back({action.task, a});
      come_by(world.place(action.to), a, open[agent], visits[agent]);
    }
  }
  return visits;
}

}  // namespace grove::detail
