// SPDX-License-Identifier: MIT
// Random maps, paths and constraints for the fuzz tests of single-agent search.
#pragma once

#include <random>
#include <vector>

#include "model/plan.h"
#include "planning/constraint.h"

namespace grove::detail::testing {

// Returns a small map with doors, corridors, dead ends or loops.
Grid random_corridor_map(std::mt19937& random);

// Returns a map of at most six by four cells with at least one passable cell.
Grid random_small_map(std::mt19937& random);

// Returns a random passable cell.
Cell random_cell(const Grid& grid, std::mt19937& random);

// Returns a path of at most `max` steps, including waits, from a random cell or from `start`.
Path random_walk(const Grid& grid, std::mt19937& random, int max = 12);
Path random_walk_from(Cell start, const Grid& grid, std::mt19937& random, int max = 12);

// Returns a vertex or edge constraint. Often it concerns the path or one of `goals` (not empty),
// and sometimes it has no end.
Constraint random_bar(const Grid& grid, const Path& path, const std::vector<Cell>& goals,
                      std::mt19937& random);

// Returns a path constraint of some other kind. It is likely to affect an agent that takes `path`
// and might rest on one of `goals` (not empty).
Constraint random_conditional_constraint(const Grid& grid, const Path& path,
                                         const std::vector<Cell>& goals, std::mt19937& random);

}  // namespace grove::detail::testing
