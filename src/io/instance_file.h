// SPDX-License-Identifier: MIT
// Instances as files: *.cts.json with its map beside it, or Moving AI .scen + .map (docs/design.md,
// section 5). Every reader throws InputError on anything malformed; it never returns half an
// instance.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "io/atomic_file.h"
#include "io/input_rules.h"
#include "model/instance.h"

namespace grove::detail {

// An instance and where it came from.
struct LoadedInstance {
  Instance instance;
  std::filesystem::path map_path;     // the map file that was read; empty: the map was in the file
  std::vector<std::string> warnings;  // one line each: unusual map characters, ...
};

// Reads a *.cts.json file and the map it names (relative to the file).
LoadedInstance read_instance(const std::filesystem::path& path, const InputRules& rules = {});
// The same of the text of such a file: `name` stands for it in messages, and the map is relative to
// `folder` (".": the current one).
LoadedInstance parse_instance(std::string_view text, const std::string& name,
                              const std::filesystem::path& folder, const InputRules& rules = {});
// What such a file says of agents and tasks, {"agents": [...], "tasks": [...]}, added to `builder`,
// which has the map.
Instance parse_instance_on(InstanceBuilder builder, std::string_view text, const std::string& name);

// Classical MAPF: the first `agents` rows of a scenario as they stand, ids a0, a1, ...; no tasks.
LoadedInstance read_scenario_instance(const std::filesystem::path& scenario,
                                      const std::filesystem::path& map, int agents,
                                      const InputRules& rules = {});

// Writes classical MAPF as a scenario, one row per agent, whole or not at all; `map` is the map's
// file name. The length column is the 4-connected distance (write_scenario). Throws
// NotRepresentable for tasks, for agents without a destination or out of its reach, and for ids
// that are not the default ones; InputError when the file cannot be written or the name has blanks
// in it.
void write_scenario_instance(const std::filesystem::path& path, const Instance& instance,
                             const std::string& map);

// The text of such a file; without a map if `map` is empty, as parse_instance_on() reads it.
std::string instance_text(const Instance& instance, const std::string& map);
// Writes `instance` as *.cts.json, whole or not at all; `map` is stored as it is given and should
// be relative to the file. Throws InputError when the file cannot be written.
void write_instance(const std::filesystem::path& path, const Instance& instance,
                    const std::string& map, Durability outlives = Durability::kMachine);

}  // namespace grove::detail
