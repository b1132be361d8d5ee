// SPDX-License-Identifier: MIT
// Classical MAPF as Moving AI's benchmark has it: scenarios, each with several numbers of agents.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "batch/entry.h"

namespace grove::detail::batch {

struct ScenarioSweep {
  std::vector<int> agents;      // rising
  std::string scenarios = "*";  // which: a name without .scen, with * for anything
};

struct SweptScenarios {
  std::vector<Entry> entries;
  int too_short = 0;  // scenarios that have too few rows for some of the numbers
};

// `place`: FILE.scen, or a folder with such files in it or below, as Moving AI's archives unpack.
// The map that a scenario names is the file of that name beside it, else the only one of that name
// in the folder or below. Throws InputError.
SweptScenarios read_scenarios(const std::filesystem::path& place, const ScenarioSweep& sweep,
                              const InputRules& rules = {});

// Whether there are scenarios there, and no *.cts.json.
bool holds_scenarios(const std::filesystem::path& place);

// "room-*-1" and the like.
bool matches(std::string_view name, std::string_view pattern);

}  // namespace grove::detail::batch
