// SPDX-License-Identifier: MIT
// Random tiny instances, small enough for the oracle and nasty enough for the search.
#pragma once

#include <cstdint>

#include "tests/fuzz/tiny_instance.h"

namespace grove::detail::fuzz {

// Always a valid instance; not always one that can be solved. The same seed makes the same one.
TinyInstance random_instance(std::uint64_t seed);

// The same with exactly `agents` agents, if the map has room for them.
TinyInstance random_instance(std::uint64_t seed, int agents);

// On a roadmap: roads of several lengths, some one way, some twice.
TinyInstance random_roads(std::uint64_t seed);

// A mixture: on a grid or roads, agents that turn, work that takes time, several tasks on a cell,
// agents with nothing to do, starts on the way.
TinyInstance random_world(std::uint64_t seed);
// This instance with agents that turn and the like, however large it is.
TinyInstance with_motions(TinyInstance instance, std::uint64_t seed);

}  // namespace grove::detail::fuzz
