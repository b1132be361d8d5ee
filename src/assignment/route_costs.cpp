// SPDX-License-Identifier: MIT
#include "assignment/route_costs.h"

#include <set>

namespace grove::detail {
namespace {

// The states in which the agent may rest on `goal`.
std::vector<State> states_at_rest(const Instance& instance, AgentIndex agent, Place goal) {
  std::vector<State> states;
  instance.world().for_each_state(goal, [&](State state) {
    if (instance.may_rest(agent, state)) states.push_back(state);
  });
  return states;
}

}  // namespace

RouteCosts::RouteCosts(const Instance& instance, const DistanceFields& distances)
    : instance_(instance), distances_(distances), tasks_(instance.tasks().size()) {
  const World& world = instance.world();
  std::set<int> kinds;
  for (const Agent& agent : instance.agents()) kinds.insert(agent.kind);
  legs_.resize(static_cast<std::size_t>(*kinds.rbegin()) + 1);
  for (const int kind : kinds) {
    legs_[kind].resize(tasks_ * tasks_);
    for (TaskIndex from = 0; from < instance.task_count(); ++from)
      for (TaskIndex to = 0; to < instance.task_count(); ++to)
        legs_[kind][static_cast<std::size_t>(from) * tasks_ + to] =
            min_distance_from(world, instance.task(from).cell, kind, distances.to_task(to));
  }
  for (AgentIndex i = 0; i < instance.agent_count(); ++i) {
    const Agent& agent = instance.agent(i);
    for (const Place goal : agent.destinations()) {
      const auto [known, is_new] = goals_.try_emplace({goal, agent.kind, agent.goal_heading});
      if (!is_new) continue;
      Goal& made = known->second;
      made.distances = distance_field(world, states_at_rest(instance, i, goal));
      for (const Task& task : instance.tasks())
        made.legs.push_back(
            min_distance_from(world, task.cell, agent.kind, DistanceView(made.distances)));
    }
  }
}

}  // namespace grove::detail
