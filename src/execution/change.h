// SPDX-License-Identifier: MIT
// Changes to an instance during the execution of its plan: new and dropped tasks, closed places and
// roads.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/plan.h"

namespace grove::detail {

struct NewTask {
  std::string id;
  Place place = kNoPlace;
  std::vector<std::string> agents;  // by id
  Time duration = 0;
  std::optional<int> need = {};  // nullopt: all its agents must visit it
};

struct InstanceChange {
  std::vector<NewTask> new_tasks;
  std::vector<std::string> dropped_tasks;  // by id
  std::vector<Place> blocked;              // cells, or vertices of a roadmap with their roads
  std::vector<int> closed_roads;           // positions in Roadmap::roads()
};

// The changed instance, and the part of the plan that is still possible. A path that enters a
// closed place or road ends before that place or road.
struct Changed {
  Instance instance;
  Plan plan;
  // By AgentIndex: the agent's plan is no longer valid for the tasks that it must visit, or one of
  // the tasks that it must visit, or visits by choice, was dropped.
  std::vector<bool> affected;
  std::vector<bool> cut;  // by AgentIndex: the path was cut before a closed place or road
};

// Applies a change. Precondition: `plan` is valid, or is Changed::plan of an earlier change. New
// tasks with a choice of agents affect no agent; the plan does not serve them. If nothing is
// closed, all states keep their numbers, except for states at work. Throws InstanceError with field
// "new_tasks/<i>/...", "dropped_tasks/<i>", "blocked/<i>" or "closed_roads/<i>" if a part of the
// change is impossible. A place or road cannot be closed if an agent starts there, or if it is the
// place of a destination or of a task that is not dropped. Of several goals of an agent, closed
// ones are removed; one must be left. A cell that is blocked on the map cannot be closed either.
Changed apply(const Instance& instance, const Plan& plan, const InstanceChange& change);

}  // namespace grove::detail
