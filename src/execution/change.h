// SPDX-License-Identifier: MIT
// Changes of an instance while its plan is executed: new and dropped tasks, closed places and
// roads.
#pragma once

#include <string>
#include <vector>

#include "model/plan.h"

namespace grove::detail {

struct NewTask {
  std::string id;
  Place place = kNoPlace;
  std::vector<std::string> agents;  // by id
  Time duration = 0;
};

struct InstanceChange {
  std::vector<NewTask> new_tasks;
  std::vector<std::string> dropped_tasks;  // by id
  std::vector<Place> blocked;     // cells of a grid; or vertices of a roadmap, with all their roads
  std::vector<int> closed_roads;  // positions in Roadmap::roads()
};

// The changed instance, and the part of the plan that is still possible. A path that enters a
// closed place or road ends before it.
struct Changed {
  Instance instance;
  Plan plan;
  // By AgentIndex: the agent's part of the plan no longer fulfils its tasks, or a task was dropped.
  std::vector<bool> affected;
  std::vector<bool> cut;  // its path enters a closed place or road
};

// `plan` must be valid, or the rest of a plan after an earlier change. If nothing is closed, states
// keep their numbers, except for states of agents at work. Throws InstanceError with field
// "new_tasks/<i>/...", "dropped_tasks/<i>", "blocked/<i>" or "closed_roads/<i>". A place or road
// cannot be closed if an agent is there, if it is an agent's destination, or if it has a task that
// is not dropped. A blocked cell of the map cannot be closed either.
Changed apply(const Instance& instance, const Plan& plan, const InstanceChange& change);

}  // namespace grove::detail
