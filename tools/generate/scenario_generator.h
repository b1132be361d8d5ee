// SPDX-License-Identifier: MIT
// Generates scenarios like the random scenarios of Moving AI: starts are distinct, goals are
// distinct, and every goal is reachable.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/scenario_file.h"

namespace grove::detail {

// Draws `count` rows within the largest component of `grid`; no goal is the start of its own row.
// `map`: file name of the map. `purpose`: use of the scenario, for error messages. Throws
// InputError if the component has too few cells.
std::vector<ScenarioRow> random_scenario(const Grid& grid, const std::string& map, int count,
                                         std::uint64_t seed, const std::string& purpose);

// Returns the distance from start to goal for each row, in moves to 4 neighbours.
std::vector<Time> scenario_lengths(const Grid& grid, const std::vector<ScenarioRow>& rows);

}  // namespace grove::detail
