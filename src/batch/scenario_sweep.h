// SPDX-License-Identifier: MIT
// Instances of classical MAPF from Moving AI's benchmark: scenarios, each with several numbers of
// agents.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "batch/entry.h"

namespace grove::detail::batch {

struct ScenarioSweep {
  std::vector<int> agents;      // numbers of agents, in ascending order
  std::string scenarios = "*";  // names without .scen; * matches any text
};

struct SweptScenarios {
  std::vector<Entry> entries;
  int too_short = 0;  // number of scenarios with too few rows for some numbers of agents
};

// Lists the instances of a sweep. `place` is FILE.scen, or a folder with such files in it or below,
// as in Moving AI's archives. The map that a scenario names is the file of that name in the
// scenario's folder; if there is none, it is the only file of that name in `place` or below. Throws
// InputError if a file cannot be read, a map is missing or ambiguous, or there is no instance.
SweptScenarios read_scenarios(const std::filesystem::path& place, const ScenarioSweep& sweep,
                              const InputRules& rules = {});

// True if `place` is a scenario, or a folder that contains scenarios but no *.cts.json files in it
// or below. Throws InputError if the folder cannot be read.
bool holds_scenarios(const std::filesystem::path& place);

// True if `name` matches `pattern`, for example "room-*-1", where * matches any text.
bool matches(std::string_view name, std::string_view pattern);

}  // namespace grove::detail::batch
