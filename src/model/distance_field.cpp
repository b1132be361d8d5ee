// SPDX-License-Identifier: MIT
#include "grove/model/distance_field.h"

namespace grove {

DistanceField distance_field(const Grid& grid, Cell target) {
  DistanceField distance(grid.cell_count(), kNever);
  std::vector<Cell> queue{target};
  queue.reserve(grid.passable_count());
  distance[target] = 0;
  for (std::size_t head = 0; head < queue.size(); ++head) {
    const Cell cell = queue[head];
    for (Cell next : grid.neighbors(cell)) {
      if (distance[next] != kNever) continue;
      distance[next] = distance[cell] + 1;
      queue.push_back(next);
    }
  }
  return distance;
}

DistanceFields::DistanceFields(const Instance& instance, const Limits& limits) {
  std::vector<Cell> targets;
  for (const Task& task : instance.tasks()) targets.push_back(task.cell);
  for (const Agent& agent : instance.agents())
    if (agent.goal) targets.push_back(*agent.goal);

  const auto cells = static_cast<std::size_t>(instance.grid().cell_count());
  if (!limits.memory_allows(targets.size() * cells * sizeof(Time))) {
    limits.memory_exhausted();
    return;
  }
  fields_.resize(cells);
  for (Cell target : targets) {
    if (limits.stop_requested()) return;
    if (!fields_[target])
      fields_[target] = std::make_unique<DistanceField>(distance_field(instance.grid(), target));
  }
  complete_ = true;
}

}  // namespace grove
