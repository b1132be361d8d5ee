// SPDX-License-Identifier: MIT
// Sets of instances: every combination of scenarios, agents and tasks, with a list of them all.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "model/grid.h"
#include "tools/generate/instance_generator.h"

namespace grove::detail {

// A scenario, what stands for it in file names ("s7"), and the seed of its tasks.
struct NumberedScenario {
  std::string number;
  Scenario scenario;
  std::int64_t seed = 0;
};

// The part of a set that is on one map.
struct MapSet {
  std::string map;  // the file
  Grid grid;
  std::vector<NumberedScenario> scenarios;
};

// What is made of each scenario: all combinations.
struct SetSizes {
  std::vector<std::int64_t> agents;
  std::vector<std::int64_t> tasks;
  std::vector<bool> mg{false};  // CTS-MAPF, MG-MAPF
  Extras extras = {};           // the same in all
};

// Throws what generate_instance() throws when a combination does not fit.
void require_fitting(const std::vector<MapSet>& maps, const SetSizes& sizes);

// Writes DIR/MAP_sS_nN_mM.cts.json (the suffix of the extras is added, and _mg to MG-MAPF ones) and
// DIR/manifest.txt, which lists them, and says so; of a set with both, manifest-cts.txt and
// manifest-mg.txt beside it list each. The folder is made if missing. Throws InputError.
void write_set(const std::filesystem::path& directory, const std::vector<MapSet>& maps,
               const SetSizes& sizes);

}  // namespace grove::detail
