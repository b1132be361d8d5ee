// SPDX-License-Identifier: MIT
#include "grove/model/distance_field.h"

namespace grove {

DistanceField distance_field(const World& world, Place target) {
  DistanceField distance(static_cast<std::size_t>(world.state_count()), kNever);
  std::vector<State> queue;
  const auto reach = [&](State state, Time steps) {
    if (distance[state] != kNever) return;
    distance[state] = steps;
    queue.push_back(state);
  };
  world.for_each_state(target, [&](State state) { reach(state, 0); });
  for (std::size_t head = 0; head < queue.size(); ++head)
    for (State before : world.moves_to(queue[head])) reach(before, distance[queue[head]] + 1);
  return distance;
}

DistanceFields::DistanceFields(const Instance& instance, const Limits& limits) {
  std::vector<Place> targets;
  for (const Task& task : instance.tasks()) targets.push_back(task.cell);
  for (const Agent& agent : instance.agents())
    if (agent.goal) targets.push_back(*agent.goal);

  const World& world = instance.world();
  const auto states = static_cast<std::size_t>(world.state_count());
  if (!limits.memory_allows(targets.size() * states * sizeof(Time))) {
    limits.memory_exhausted();
    return;
  }
  fields_.resize(static_cast<std::size_t>(world.place_count()));
  for (Place target : targets) {
    if (limits.stop_requested()) return;
    if (!fields_[target])
      fields_[target] = std::make_unique<DistanceField>(distance_field(world, target));
  }
  complete_ = true;
}

}  // namespace grove
