// SPDX-License-Identifier: MIT
// Sets of instances: every combination of scenarios, agents and tasks, with a manifest.
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

// The part of a set on one map.
struct MapSet {
  std::string map;  // path of the file
  Grid grid;
  std::vector<NumberedScenario> scenarios;
};

// Sizes of instances; each scenario is combined with all of them.
struct SetSizes {
  std::vector<std::int64_t> agents;
  std::vector<std::int64_t> tasks;
  std::vector<bool> mg{false};  // false: CTS-MAPF, true: MG-MAPF
  Extras extras = {};           // the same in all instances
};

// Throws what generate_instance() throws if a combination is impossible.
void require_fitting(const std::vector<MapSet>& maps, const SetSizes& sizes);

// Writes DIR/MAP_sS_nN_mM.cts.json, followed by the suffix of the extras and _mg for MG-MAPF, and
// DIR/manifest.txt, which lists them; prints a summary. For a set with both problems, also writes
// manifest-cts.txt and manifest-mg.txt, which list one each. Creates the folder if missing. Throws
// InputError.
void write_set(const std::filesystem::path& directory, const std::vector<MapSet>& maps,
               const SetSizes& sizes);

}  // namespace grove::detail
