// SPDX-License-Identifier: MIT
// Least costs of the legs between the stops of all agents, without other agents.
#pragma once

#include <algorithm>
#include <map>
#include <tuple>
#include <vector>

#include "model/distance_field.h"
#include "model/instance.h"

namespace grove::detail {

// The costs of legs in steps; kNever: there is no path. A leg to a task includes its execution. If
// agents need time to turn, a leg costs the minimum over the headings at its begin. One thread at a
// time.
class RouteCosts {
 public:
  // Both must outlive this object. `distances` must be complete.
  RouteCosts(const Instance& instance, const DistanceFields& distances);

  const Instance& instance() const { return instance_; }
  Time from_start(AgentIndex agent, TaskIndex to) const {
    return distances_.to_task(to)[instance_.agent(agent).start];
  }
  Time between(AgentIndex agent, TaskIndex from, TaskIndex to) const {
    return legs_[instance_.agent(agent).kind][static_cast<std::size_t>(from) * tasks_ + to];
  }
  // The leg to `goal`, where the agent comes to rest, from its start or from a task.
  Time start_to_goal(AgentIndex agent, Place goal) const {
    return of_goal(agent, goal).distances[instance_.agent(agent).start];
  }
  Time to_goal(AgentIndex agent, TaskIndex from, Place goal) const {
    return legs_to_goal(agent, goal)[from];
  }
  // The distances to the states in which the agent may rest on `goal`, one of its destinations.
  DistanceView distances_to_goal(AgentIndex agent, Place goal) const {
    return DistanceView(of_goal(agent, goal).distances);
  }
  // The legs to `goal` from all tasks.
  const std::vector<Time>& legs_to_goal(AgentIndex agent, Place goal) const {
    return of_goal(agent, goal).legs;
  }

 private:
  struct Goal {
    DistanceField distances;
    std::vector<Time> legs;  // by task
  };

  const Goal& of_goal(AgentIndex agent, Place goal) const {
    const Agent& a = instance_.agent(agent);
    return goals_.at({goal, a.kind, a.goal_heading});
  }

  const Instance& instance_;
  const DistanceFields& distances_;
  std::size_t tasks_;
  std::vector<std::vector<Time>> legs_;  // by kind, then first task and second task
  std::map<std::tuple<Place, int, std::optional<Heading>>, Goal> goals_;
};

}  // namespace grove::detail
