// SPDX-License-Identifier: MIT
// Few agents on small boards with corridors, where everybody is in everybody's way.
#pragma once

#include <cstdint>

#include "tests/fuzz/tiny_instance.h"

namespace grove::detail::fuzz {

// 3 to 5 agents on a board of 8 to 25 cells, one or two tasks for each, half of them without
// destinations. Not always one that can be solved. The same seed makes the same one.
TinyInstance random_puzzle(std::uint64_t seed);

}  // namespace grove::detail::fuzz
