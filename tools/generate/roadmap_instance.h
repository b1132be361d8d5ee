// SPDX-License-Identifier: MIT
// Instances on roadmaps.
#pragma once

#include <optional>
#include <string>

#include "model/roadmap.h"
#include "tools/generate/instance_generator.h"

namespace grove::detail {

// A roadmap, and the prefixes of the ids of vertices for agents and for tasks.
struct Site {
  std::string name;  // file of the roadmap, for messages
  Roadmap roadmap;
  // nullopt: agents are on dead ends, where they block no other agent, if there are enough of them,
  // else on any vertices. Tasks are on the vertices that are not for agents, or on any if agents
  // may be on any.
  std::optional<std::string> agents_on = {};
  std::optional<std::string> tasks_on = {};
};

// Generates an instance with agents a0, a1, ... on distinct starts with distinct goals, none on its
// own start if there are two vertices to choose from. Tasks t0, t1, ... are on distinct vertices
// where no agent starts, each given to 1, 2 or 3 distinct agents. All are in the largest strongly
// connected component of the roadmap. Throws InputError, which names the roadmap, if that component
// has too few vertices, or if an agent would get more than kMaxTasksPerAgent tasks.
Instance generate_instance(const Site& site, const InstanceRequest& request);

}  // namespace grove::detail
