// SPDX-License-Identifier: MIT
// Instances on roadmaps.
#pragma once

#include <optional>
#include <string>

#include "model/roadmap.h"
#include "tools/generate/instance_generator.h"

namespace grove::detail {

// A roadmap, and which of its vertices are for what: those whose ids begin so.
struct Site {
  std::string name;  // the roadmap's file, for messages
  Roadmap roadmap;
  // None: agents are on dead ends, where they are in nobody's way, if there is one for each of
  // them, else anywhere; tasks are on all vertices that are not for agents, or anywhere as these
  // are.
  std::optional<std::string> agents_on = {};
  std::optional<std::string> tasks_on = {};
};

// Agents a0, a1, ... with distinct starts and distinct goals, none on its own start if there are
// two vertices to choose from; tasks t0, t1, ... on distinct vertices where no agent starts, each
// given to 1, 2 or 3 distinct agents. All lie in the largest part of the roadmap in which every
// vertex can be reached from every other. Throws InputError, naming the roadmap, when that has too
// few vertices, or an agent would get more than kMaxTasksPerAgent tasks.
Instance generate_instance(const Site& site, const InstanceRequest& request);

}  // namespace grove::detail
