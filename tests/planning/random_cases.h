// SPDX-License-Identifier: MIT
// Random maps, paths and constraints for the fuzz tests of single-agent search.
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

// A random passable cell.
Cell random_cell(const Grid& grid, std::mt19937& random);

// A path of at most `max` steps, some of them waits, from a random cell or from `start`.
Path random_walk(const Grid& grid, std::mt19937& random, int max = 12);
Path random_walk_from(Cell start, const Grid& grid, std::mt19937& random, int max = 12);

// A vertex or edge constraint: often on the path, often on one of `goals` (not empty), sometimes
// for ever.
Constraint random_bar(const Grid& grid, const Path& path, const std::vector<Cell>& goals,
                      std::mt19937& random);

// A constraint of one of the other kinds on paths. It probably affects an agent that took `path`
// and may have to rest on one of `goals` (not empty).
Constraint random_conditional_constraint(const Grid& grid, const Path& path,
                                         const std::vector<Cell>& goals, std::mt19937& random);

}  // namespace grove::detail::testing
