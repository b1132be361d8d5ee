// SPDX-License-Identifier: MIT
// Scenarios like Moving AI's random ones: distinct starts, distinct goals, every goal reachable.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/scenario_file.h"

namespace grove::detail {

// Draws `count` rows within the map's largest component; no goal is the start of its own row. `map`
// is the map's file name. Throws InputError, which names the map and `purpose`, if the component
// has too few cells.
std::vector<ScenarioRow> random_scenario(const Grid& grid, const std::string& map, int count,
                                         std::uint64_t seed, const std::string& purpose);

// Returns the 4-connected distance from start to goal for each row.
std::vector<Time> scenario_lengths(const Grid& grid, const std::vector<ScenarioRow>& rows);

}  // namespace grove::detail
