// SPDX-License-Identifier: MIT
// Random puzzles: a few agents that block each other on small boards with corridors.
#pragma once

#include <cstdint>

#include "tests/fuzz/tiny_instance.h"

namespace grove::detail::fuzz {

// Returns a puzzle with 3 to 5 agents on a board of 8 to 25 cells. Either each agent has one task
// or each has two; in half of the puzzles no agent has a destination. A plan need not exist. The
// same seed gives the same puzzle.
TinyInstance random_puzzle(std::uint64_t seed);

}  // namespace grove::detail::fuzz
