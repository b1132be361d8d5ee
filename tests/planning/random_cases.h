// SPDX-License-Identifier: MIT
// Random matter for the fuzz tests of the low levels.
#pragma once

#include <random>
#include <vector>

#include "model/plan.h"
#include "planning/constraint.h"

namespace grove::detail::testing {

// A small map with doors, corridors, dead ends or loops.
Grid random_corridor_map(std::mt19937& random);

// A map of at most six by four cells, its first one passable.
Grid random_small_map(std::mt19937& random);

// A passable cell.
Cell random_cell(const Grid& grid, std::mt19937& random);

// A path of at most `most` steps, some of them waits, from anywhere or from `start`.
Path random_walk(const Grid& grid, std::mt19937& random, int most = 12);
Path random_walk_from(Cell start, const Grid& grid, std::mt19937& random, int most = 12);

// A bar, often on the path, often on one of `goals` (not empty), now and then for ever.
Constraint random_bar(const Grid& grid, const Path& path, const std::vector<Cell>& goals,
                      std::mt19937& random);

// Of one of the kinds that are no bars, most likely one that matters to an agent that went `path`
// and may have to rest on one of `goals` (not empty).
Constraint random_conditional_constraint(const Grid& grid, const Path& path,
                                         const std::vector<Cell>& goals, std::mt19937& random);

}  // namespace grove::detail::testing
