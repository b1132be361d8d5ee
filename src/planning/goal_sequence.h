// SPDX-License-Identifier: MIT
// Goals of one agent in a fixed order, with the distances that guide its search.
#pragma once

#include <optional>
#include <vector>

#include "model/assert.h"
#include "model/distance_field.h"
#include "model/instance.h"

namespace grove::detail {

// Where an agent comes to rest.
struct PlaceOfRest {
  Place place = kNoPlace;  // kNoPlace: one of several places
  DistanceView distances;  // to the states in which it may rest
};

// The goals of one agent under a complete task sequence: its stops in the order of the sequence,
// then its place of rest. If the agent rests on its last stop, that stop is the last goal. There is
// at least one goal. The agent finishes when it rests on the last goal after visiting all goals
// before it, in order.
class GoalSequence {
 public:
  // `stops`: the tasks of all stops of the agent, in the order of visits. `distances` must outlive
  // this object.
  GoalSequence(const Instance& instance, const DistanceFields& distances, AgentIndex agent,
               const std::vector<TaskIndex>& stops);
  // For agents with a choice: `stops` are the tasks that it visits, in the order of visits. Without
  // `rest`, it rests on the last one. The distances of `rest` must outlive this object.
  GoalSequence(const Instance& instance, const DistanceFields& distances, AgentIndex agent,
               const std::vector<TaskIndex>& stops, const std::optional<PlaceOfRest>& rest);

  State start() const { return start_; }
  int size() const { return static_cast<int>(goals_.size()); }
  // Place of goal k; kNoPlace for the last goal if the place of rest is not fixed.
  Place goal(int k) const { return goals_[checked(k)]; }
  Place last() const { return goals_.back(); }
  // The task at goal k if it takes time, else -1.
  TaskIndex work(int k) const { return work_[checked(k)]; }
  bool has_work() const { return has_work_; }
  // See AgentStops::longest_finish().
  Time longest_finish(Place place) const;
  Time max_turn_time() const { return max_turn_time_; }

  // Lower bound on the steps from `state` through goals k, k+1, ... to the last one, without
  // constraints. Exact if agents turn freely. Admissible and consistent. kNever or more if there is
  // no path.
  Time distance(State state, int k) const {
    const Time to_goal = to_goal_[checked(k)][state];
    return to_goal == kNever ? kNever : to_goal + after_goal_[k];
  }

  // The two parts of distance(): the distance field of goal k, and the steps from there on (at most
  // kNever).
  DistanceView to_goal(int k) const { return to_goal_[checked(k)]; }
  Time after_goal(int k) const { return after_goal_[checked(k)]; }

 private:
  int checked(int k) const {
    GROVE_ASSERT(k >= 0 && k < size(), "the index is that of a goal of the sequence");
    return k;
  }

  State start_;
  Time max_turn_time_;
  bool has_work_ = false;
  std::vector<Place> goals_;
  std::vector<TaskIndex> work_;
  std::vector<Time> durations_;
  std::vector<DistanceView> to_goal_;
  std::vector<Time> after_goal_;  // least steps from goal k through all later goals
};

}  // namespace grove::detail
