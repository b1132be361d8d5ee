// SPDX-License-Identifier: MIT
// Agents of tiny instances, one after the other.
#pragma once

#include <cstdint>
#include <memory>

#include "grove/detail/joint/agent_graph.h"
#include "grove/detail/model/distance_field.h"
#include "grove/detail/planning/agent_stops_store.h"
#include "tests/fuzz/random_instance.h"

namespace grove::detail::lagrangian_test {

inline Instance tiny_instance(std::uint64_t seed) {
  return (seed % 2 == 0 ? fuzz::random_instance(seed) : fuzz::random_world(seed)).build();
}

// What is known of the agents of an instance.
struct Known {
  explicit Known(Instance the_instance)
      : instance(std::move(the_instance)), distances(instance), stops(instance, distances) {}

  Instance instance;
  DistanceFields distances;
  AgentStopsStore stops;
};

}  // namespace grove::detail::lagrangian_test
