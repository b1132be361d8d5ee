// SPDX-License-Identifier: MIT
#include "grove/planning/goal_sequence.h"

#include <algorithm>
#include <stdexcept>

namespace grove {

GoalSequence::GoalSequence(const Instance& instance, const DistanceFields& distances,
                           AgentIndex agent, const std::vector<TaskIndex>& tasks)
    : start_(instance.agent(agent).start) {
  for (TaskIndex task : tasks) goals_.push_back(instance.task(task).cell);
  if (const std::optional<Cell> destination = instance.agent(agent).goal)
    goals_.push_back(*destination);
  if (goals_.empty()) throw std::invalid_argument("an agent without a destination needs a task");

  for (Cell goal : goals_) to_goal_.push_back(&distances.to(goal));
  after_goal_.assign(goals_.size(), 0);
  for (int k = size() - 2; k >= 0; --k)
    after_goal_[k] = std::min(kNever, distance(goals_[k], k + 1));
}

}  // namespace grove
