// SPDX-License-Identifier: MIT
// What may become of an instance while its plan is driven: other tasks, ways that are closed.
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
  std::vector<Place> blocked;     // cells of a grid, or vertices of a roadmap, with all their roads
  std::vector<int> closed_roads;  // positions in Roadmap::roads()
};

// The instance that comes of it, and what a plan of the one before still says. A path that comes to
// what is closed ends before it.
struct Changed {
  Instance instance;
  Plan plan;
  // By AgentIndex: its part of the plan does not do any more, or no longer need be what it is.
  std::vector<bool> affected;
  std::vector<bool> cut;  // its path comes to what is closed
};

// `plan` must be a valid one, or what an earlier change left of one. On a map on which nothing is
// closed states keep their numbers, but for those of agents at work. Throws InstanceError: field
// "new_tasks/<i>/...", "dropped_tasks/<i>", "blocked/<i>" or "closed_roads/<i>" - an agent is
// there, is to end or has to visit there (and the task is not dropped), or it is a wall.
Changed apply(const Instance& instance, const Plan& plan, const InstanceChange& change);

}  // namespace grove::detail
