// SPDX-License-Identifier: MIT
// Tiny instances and their planning data for tests of the Lagrangian bound.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "joint/agent_graph.h"
#include "model/distance_field.h"
#include "planning/agent_stops_cache.h"
#include "tests/fuzz/random_instance.h"

namespace grove::detail::lagrangian_test {

inline Instance tiny_instance(std::uint64_t seed) {
  return fuzz::any_instance(seed).build();
}

// Two agents that must pass each other in a corridor with one bay. The multipliers keep changing
// for many rounds.
inline Instance corridor() {
  // . . . . .
  // @ @ . @ @
  std::vector<bool> passable(10, true);
  for (const int wall : {5, 6, 8, 9}) passable[wall] = false;
  InstanceBuilder builder{Map(Grid(5, 2, passable))};
  builder.add_agent("a", Position{0, 0}, Position{4, 0});
  builder.add_agent("b", Position{4, 0}, Position{0, 0});
  return std::move(builder).build();
}

// An instance with the distances and stops of its agents.
struct TinyProblem {
  explicit TinyProblem(Instance the_instance)
      : instance(std::move(the_instance)), distances(instance), stops(instance, distances) {}

  Instance instance;
  DistanceFields distances;
  AgentStopsCache stops;
};

}  // namespace grove::detail::lagrangian_test
