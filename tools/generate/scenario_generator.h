// SPDX-License-Identifier: MIT
// Scenarios as Moving AI's random ones: distinct starts, distinct goals, each goal within reach.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/scenario_file.h"

namespace grove::detail {

// Draws `count` rows within the map's largest connected part; no goal is its own row's start.
// `map` is the map's file name. Throws InputError, naming it and what the rows are for, when the
// part has fewer cells.
std::vector<ScenarioRow> random_scenario(const Grid& grid, const std::string& map, int count,
                                         std::uint64_t seed, const std::string& purpose);

// The 4-connected distance from start to goal, by row.
std::vector<Time> scenario_lengths(const Grid& grid, const std::vector<ScenarioRow>& rows);

}  // namespace grove::detail
