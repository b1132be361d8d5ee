// SPDX-License-Identifier: MIT
// Assignments: which agents visit the tasks that need only some of their agents, and where agents
// with a choice of goals come to rest.
#pragma once

#include <compare>
#include <optional>
#include <vector>

#include "model/instance.h"
#include "model/plan.h"

namespace grove::detail {

// The choices of one agent.
struct AgentChoice {
  std::vector<TaskIndex> visits;   // optional tasks that it visits, in ascending order
  std::optional<Place> goal = {};  // its destination, one of Agent::goals; nullopt: no choice
  friend auto operator<=>(const AgentChoice&, const AgentChoice&) = default;
};

using Assignment = std::vector<AgentChoice>;  // by AgentIndex

// Does `assignment` give each task as many agents as it needs, and each agent with a choice of
// goals one of them, such that no two agents have the same destination?
bool is_complete(const Instance& instance, const Assignment& assignment);

// Returns the instance in which the choices are fixed: an agent must visit the tasks that it visits
// by choice, and its chosen goal is its destination. Tasks and agents keep their indices. A plan of
// this instance is, after with_stated_visits(), a plan of `instance`. (The converse does not hold
// even for this assignment: without a destination, an agent that must visit no task may rest
// anywhere, but in the result it rests on a task that it visits.) Precondition: the assignment is
// complete. Throws InstanceError if an agent visits more than kMaxTasksPerAgent tasks.
Instance with_assignment(const Instance& instance, const Assignment& assignment);

// Converts a plan of with_assignment(instance, ...) to a plan of `instance`: states the visits of
// tasks that need only some of their agents, and completes a turn within which an agent with such
// tasks rests. Precondition: the plan is valid.
Plan with_stated_visits(const Instance& instance, Plan plan);

}  // namespace grove::detail
