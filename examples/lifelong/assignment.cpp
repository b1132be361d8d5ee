// SPDX-License-Identifier: MIT
#include "examples/lifelong/assignment.h"

#include <algorithm>
#include <set>

namespace grove::detail::lifelong {

std::vector<std::pair<AgentIndex, Errand>> Assignment::give(const Instance& now) {
  std::vector<std::pair<AgentIndex, Errand>> given;
  std::set<Cell> taken;
  for (const Task& task : now.tasks()) taken.insert(task.cell);
  std::vector<AgentIndex> free;
  for (AgentIndex robot = 0; robot < now.agent_count(); ++robot)
    if (now.agent(robot).is_idle()) free.push_back(robot);
  for (auto errand = open_.begin(); errand != open_.end() && !free.empty();) {
    if (!taken.insert(errand->cell).second) {
      ++errand;
      continue;
    }
    const DistanceField distance = distance_field(grid_, errand->cell);
    const auto nearest = std::ranges::min_element(free, {}, [&](AgentIndex robot) {
      return distance[now.world().place(now.agent(robot).start)];
    });
    given.emplace_back(*nearest, *errand);
    free.erase(nearest);
    errand = open_.erase(errand);
  }
  return given;
}

}  // namespace grove::detail::lifelong
