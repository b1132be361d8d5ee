// SPDX-License-Identifier: MIT
// Random tiny instances, small enough for the oracle but difficult for the search.
#pragma once

#include <cstdint>

#include "tests/fuzz/tiny_instance.h"

namespace grove::detail::fuzz {

// Returns a valid instance on a grid, possibly without a plan. The same seed gives the same
// instance.
TinyInstance random_instance(std::uint64_t seed);

// Like random_instance(seed), but with exactly `agents` agents, or fewer if the map has no room.
TinyInstance random_instance(std::uint64_t seed, int agents);

// Returns an instance on a roadmap with roads of random lengths, some of them one-way or parallel.
TinyInstance random_roads(std::uint64_t seed);

// Returns an instance on a grid or a roadmap, with some of: turning agents, tasks with a duration,
// several tasks on a cell, idle agents, and starts on a road, during a turn or during a task.
TinyInstance random_world(std::uint64_t seed);
// An instance of any kind: random_instance() or random_world().
TinyInstance any_instance(std::uint64_t seed);
// Adds some features of random_world() to `instance`, which can have any size.
TinyInstance with_motions(TinyInstance instance, std::uint64_t seed);

}  // namespace grove::detail::fuzz
