// SPDX-License-Identifier: MIT
// Reads and writes instances: *.cts.json with its map file, or Moving AI .scen and .map
// (docs/design.md, section 5). Every reader throws InputError for invalid files. It never returns a
// part of an instance.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "io/atomic_file.h"
#include "io/input_rules.h"
#include "model/instance.h"

namespace grove::detail {

// An instance and its origin.
struct LoadedInstance {
  Instance instance;
  std::filesystem::path map_path;     // the map file; empty: the map was in the instance file
  std::vector<std::string> warnings;  // one line each: unusual map characters, ...
};

// Reads a *.cts.json file and the map that it names (relative to the file).
LoadedInstance read_instance(const std::filesystem::path& path, const InputRules& rules = {});
// The same for the text of such a file. `name` stands for the file in messages. The map is relative
// to `folder` (".": the current one).
LoadedInstance parse_instance(std::string_view text, const std::string& name,
                              const std::filesystem::path& folder, const InputRules& rules = {});
// Reads the agents and tasks of such a file, {"agents": [...], "tasks": [...]}, and adds them to
// `builder`, which has the map.
Instance parse_instance_on(InstanceBuilder builder, std::string_view text, const std::string& name);

// Reads classical MAPF: the first `agents` rows of a scenario. The ids are a0, a1, ...; there are
// no tasks.
LoadedInstance read_scenario_instance(const std::filesystem::path& scenario,
                                      const std::filesystem::path& map, int agents,
                                      const InputRules& rules = {});

// Writes classical MAPF as a scenario, atomically, one row per agent. `map` is the file name of the
// map. The length column is the 4-connected distance (write_scenario). Throws NotRepresentable for
// tasks, for agents without a destination or with an unreachable one, and for ids that are not the
// default ones. Throws InputError if the file cannot be written or the name contains blanks.
void write_scenario_instance(const std::filesystem::path& path, const Instance& instance,
                             const std::string& map);

// The text of such a file. If `map` is empty, the text has no map, as parse_instance_on() requires.
std::string instance_text(const Instance& instance, const std::string& map);
// Writes `instance` as *.cts.json, atomically. `map` is stored unchanged and should be relative to
// the file. Throws InputError if the file cannot be written.
void write_instance(const std::filesystem::path& path, const Instance& instance,
                    const std::string& map, Durability outlives = Durability::kMachine);

}  // namespace grove::detail
