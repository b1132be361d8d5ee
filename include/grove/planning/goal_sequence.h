// SPDX-License-Identifier: MIT
// The places one agent must visit in turn, with the distances that guide its search.
#pragma once

#include <vector>

#include "grove/model/assert.h"
#include "grove/model/distance_field.h"
#include "grove/model/instance.h"

namespace grove {

// The goals of one agent under a complete task sequence: its tasks in that order, then its
// destination. For an MG agent the last task is the last goal. Never empty. The agent finishes when
// it rests on the last goal having visited all before it, in order.
class GoalSequence {
 public:
  // `tasks`: all the agent's tasks in the order to visit. `instance` and `distances` must outlive
  // this. Throws std::invalid_argument when nothing is left to visit (an MG agent, no tasks).
  GoalSequence(const Instance& instance, const DistanceFields& distances, AgentIndex agent,
               const std::vector<TaskIndex>& tasks);

  State start() const { return start_; }
  int size() const { return static_cast<int>(goals_.size()); }
  Place goal(int k) const { return goals_[checked(k)]; }
  Place last() const { return goals_.back(); }

  // Steps from `state` through goals k, k+1, ... to the last one, ignoring everything else: exact,
  // so admissible and consistent. kNever or more when there is no way.
  Time distance(State state, int k) const {
    const Time to_goal = (*to_goal_[checked(k)])[state];
    return to_goal == kNever ? kNever : to_goal + after_goal_[k];
  }

  // The two parts of that: the distance field of goal k, and the steps from there on (at most
  // kNever).
  const DistanceField& to_goal(int k) const { return *to_goal_[checked(k)]; }
  Time after_goal(int k) const { return after_goal_[checked(k)]; }

 private:
  int checked(int k) const {
    GROVE_ASSERT(k >= 0 && k < size(), "a goal of the sequence is asked for");
    return k;
  }

  State start_;
  std::vector<Place> goals_;
  std::vector<const DistanceField*> to_goal_;
  std::vector<Time> after_goal_;  // from goal k through the rest
};

}  // namespace grove
