// SPDX-License-Identifier: MIT
// Random matter for the fuzz tests of the low levels.
#pragma once

#include <random>
#include <vector>

#include "grove/model/plan.h"
#include "grove/planning/constraint.h"

namespace grove::testing {

// A small map with doors, corridors, dead ends or loops.
Grid random_corridor_map(std::mt19937& random);

// Of one of the kinds that are no bars, most likely one that matters to an agent that went `path`
// and may have to rest on one of `goals` (not empty).
Constraint random_conditional_constraint(const Grid& grid, const Path& path,
                                         const std::vector<Cell>& goals, std::mt19937& random);

}  // namespace grove::testing
