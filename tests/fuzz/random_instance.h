// SPDX-License-Identifier: MIT
// Random tiny instances: small enough for the oracle, and difficult for the search.
#pragma once

#include <cstdint>

#include "tests/fuzz/tiny_instance.h"

namespace grove::detail::fuzz {

// Returns a valid instance, possibly without a plan. The same seed gives the same instance.
TinyInstance random_instance(std::uint64_t seed);

// The same with exactly `agents` agents, or fewer if the map has no room for them.
TinyInstance random_instance(std::uint64_t seed, int agents);

// On a roadmap with roads of several lengths, some of them one-way or parallel.
TinyInstance random_roads(std::uint64_t seed);

// A mixture: on a grid or a roadmap, with turning agents, tasks with a duration, several tasks on a
// cell, idle agents, and starts on a road, during a turn or during a task.
TinyInstance random_world(std::uint64_t seed);
// Adds such features to `instance`, of any size.
TinyInstance with_motions(TinyInstance instance, std::uint64_t seed);

}  // namespace grove::detail::fuzz
