// SPDX-License-Identifier: MIT
// Generates instances on roadmaps.
#pragma once

#include <optional>
#include <string>

#include "model/roadmap.h"
#include "tools/generate/instance_generator.h"

namespace grove::detail {

// A roadmap, and the vertices for agents and tasks, selected by prefixes of their ids.
struct Site {
  std::string name;  // file of the roadmap, for error messages
  Roadmap roadmap;
  // Prefix of the ids of vertices for starts and goals. nullopt: dead ends if there are enough of
  // them, because an agent there blocks no other agent; otherwise all vertices.
  std::optional<std::string> agents_on = {};
  // Prefix of the ids of vertices for tasks. nullopt: all vertices that are not for agents; all
  // vertices if agents can be on all.
  std::optional<std::string> tasks_on = {};
};

// Generates an instance with agents a0, a1, ... and tasks t0, t1, .... Starts are distinct, goals
// are distinct, and no goal is the start of the same agent if there are at least two vertices for
// agents. Tasks are on distinct vertices where no agent starts. Each without a need
// (Choices::need) is assigned to 1, 2 or 3 distinct agents. With `request.mg` the goal of each agent becomes a further task of this agent,
// even if another agent starts there. All vertices are in the largest strongly connected component
// of the roadmap. Throws InputError, which names the roadmap, if that component has too few
// suitable vertices, or if an agent would have to visit more than kMaxTasksPerAgent tasks.
Instance generate_instance(const Site& site, const InstanceRequest& request);

}  // namespace grove::detail
