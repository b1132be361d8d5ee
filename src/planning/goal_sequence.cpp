// SPDX-License-Identifier: MIT
#include "planning/goal_sequence.h"

#include <algorithm>

namespace grove::detail {
namespace {

std::optional<PlaceOfRest> place_of_rest(const Instance& instance, const DistanceFields& distances,
                                         AgentIndex agent) {
  if (instance.rests_on_last_stop(agent)) return std::nullopt;
  return PlaceOfRest{instance.agent(agent).goal.value_or(kNoPlace), distances.to_rest(agent)};
}

}  // namespace

GoalSequence::GoalSequence(const Instance& instance, const DistanceFields& distances,
                           AgentIndex agent, const std::vector<TaskIndex>& stops)
    : GoalSequence(instance, distances, agent, stops, place_of_rest(instance, distances, agent)) {}

GoalSequence::GoalSequence(const Instance& instance, const DistanceFields& distances,
                           AgentIndex agent, const std::vector<TaskIndex>& stops,
                           const std::optional<PlaceOfRest>& rest)
    : start_(instance.agent(agent).start) {
  const World& world = instance.world();
  const Agent& who = instance.agent(agent);
  max_turn_time_ = world.max_turn_time(who.kind);
  const auto add = [&](Place place, TaskIndex work, Time duration, DistanceView to_goal) {
    goals_.push_back(place);
    work_.push_back(work);
    durations_.push_back(duration);
    to_goal_.push_back(to_goal);
  };
  for (const TaskIndex stop : stops) {
    const Task& task = instance.task(stop);
    add(task.cell, task.duration > 0 ? stop : -1, task.duration, distances.to_task(stop));
    has_work_ = has_work_ || task.duration > 0;
  }
  if (rest) add(rest->place, -1, 0, rest->distances);

  after_goal_.assign(goals_.size(), 0);
  for (int k = size() - 2; k >= 0; --k) {
    const Time leg = min_distance_from(world, goals_[k], who.kind, to_goal_[k + 1]);
    after_goal_[k] = leg >= kNever ? kNever : std::min(kNever, leg + after_goal_[k + 1]);
  }
}

Time GoalSequence::longest_finish(Place place) const {
  Time longest = max_turn_time_;
  for (int k = 0; k < size(); ++k)
    if (goals_[k] == place) longest += durations_[k];
  return longest;
}

}  // namespace grove::detail
