// SPDX-License-Identifier: MIT
// Assignments: which agents visit the tasks that need only some of their agents, and where agents
// with a choice of goals come to rest.
#pragma once

#include <compare>
#include <optional>
#include <string>
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
// tasks that need only some of their agents, each as early as possible if the plan does not state
// it, and completes a turn within which an agent with such tasks rests. Precondition: the plan is
// valid.
Plan with_stated_visits(const Instance& instance, Plan plan);

// The choices that a plan of `instance` makes: the optional tasks of which it states visits, and
// the goals on which the agents rest. If the plan is not valid, the assignment can be incomplete.
Assignment assignment_of(const Instance& instance, const Plan& plan);

// An instance without choices, and a plan of it.
struct FixedChoices {
  Instance instance;
  Plan plan;
};

// Fixes the choices as `plan` makes them: with_assignment(), with one addition. If an agent without
// a destination that must visit no task makes visits and then rests elsewhere, its last place
// becomes its destination. The paths stay the same. An agent whose plan states a visit after it has
// come to rest costs less than before; all others cost the same. A lower bound for `instance` also
// holds for the result, unless forbids_rest_within_turns(). Precondition: `plan` is a valid plan of
// `instance`. Throws InstanceError like with_assignment().
FixedChoices fix_choices(const Instance& instance, const Plan& plan);

// The text of an error if the destination of an agent in `fixed` is a place within a road, which
// files and the public interface cannot express; nullopt otherwise.
std::optional<std::string> destination_within_a_road(const Instance& fixed);

// True if an agent may not rest within a turn only because it has optional tasks. When the choices
// are fixed it may, so a plan can then cost less than every plan of `instance`.
bool forbids_rest_within_turns(const Instance& instance);

// The plan for an instance that fixes choices of its instance: without the visits that `fixed` does
// not require. The paths stay the same. It is valid for each agent for which serves() is true.
Plan without_other_visits(const Instance& fixed, const Plan& plan);
// True if a valid plan of an agent for an instance with choices visits exactly the tasks that
// `fixed`, an instance that fixes choices, requires of the agent, and ends where it may rest in
// `fixed`.
bool serves(const Instance& fixed, AgentIndex agent, const AgentPlan& plan);

}  // namespace grove::detail
