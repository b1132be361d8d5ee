// SPDX-License-Identifier: MIT
// Random puzzles: few agents on small boards with corridors, where all agents block each other.
#pragma once

#include <cstdint>

#include "tests/fuzz/tiny_instance.h"

namespace grove::detail::fuzz {

// Returns 3 to 5 agents on a board of 8 to 25 cells, with one or two tasks each. In half of the
// puzzles the agents have no destinations. Possibly without a plan. The same seed gives the same
// puzzle.
TinyInstance random_puzzle(std::uint64_t seed);

}  // namespace grove::detail::fuzz
