// SPDX-License-Identifier: MIT
// Sets of instances: every combination of scenario, number of agents and number of tasks, with a
// manifest.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "model/grid.h"
#include "tools/generate/instance_generator.h"

namespace grove::detail {

// A scenario, its number in file names ("s7"), and the seed of its tasks.
struct NumberedScenario {
  std::string number;
  Scenario scenario;
  std::int64_t seed = 0;
};

// The part of an instance set that uses one map.
struct MapSet {
  std::string map;  // path of the file
  Grid grid;
  std::vector<NumberedScenario> scenarios;
};

// Properties of the instances of a set. Each scenario is combined with every combination of
// `agents`, `tasks` and `mg`.
struct SetSizes {
  std::vector<std::int64_t> agents;
  std::vector<std::int64_t> tasks;
  std::vector<bool> mg{false};  // false: CTS-MAPF, true: MG-MAPF
  Extras extras = {};           // the same in all instances
  Choices choices = {};         // the same in all instances
};

// Generates all instances without writing them. Throws what generate_instance() throws if one is
// impossible.
void require_fitting(const std::vector<MapSet>& maps, const SetSizes& sizes);

// Writes the instances DIR/MAP_sS_nN_mM.cts.json (before .cts.json, the suffixes of extras and
// choices and, for MG-MAPF, _mg) and DIR/manifest.txt, which lists them. For a set with both problems, also
// writes manifest-cts.txt and manifest-mg.txt with the instances of one problem each. Creates the
// folder if it is missing and prints a summary. Throws InputError if an instance is impossible or a
// file cannot be written.
void write_set(const std::filesystem::path& directory, const std::vector<MapSet>& maps,
               const SetSizes& sizes);

}  // namespace grove::detail
