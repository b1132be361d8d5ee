// SPDX-License-Identifier: MIT
// Reads and writes instance files: *.cts.json with a map or roadmap, or Moving AI .scen with .map
// (docs/design.md, section 5). Every reader returns a complete instance, or throws InputError if a
// file is invalid.
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
  std::filesystem::path map_path;  // file of the map or roadmap; empty: it was in the instance file
  std::vector<std::string> warnings;    // one line each, for example about unusual map characters
  std::vector<std::string> hints = {};  // one line each: valid content that is often a mistake
};

// Reads a *.cts.json file, and the map or roadmap that it names (by a path relative to the file).
LoadedInstance read_instance(const std::filesystem::path& path, const InputRules& rules = {});
// Parses the text of such a file. `name` is the name of the file in messages. A map or roadmap is
// named by a path relative to `folder`; ".": the current folder.
LoadedInstance parse_instance(std::string_view text, const std::string& name,
                              const std::filesystem::path& folder, const InputRules& rules = {});
// Parses {"agents": [...], "tasks": [...]}, as in such a file, and builds the instance with these
// agents and tasks on the map of `builder`.
Instance parse_instance_on(InstanceBuilder builder, std::string_view text, const std::string& name);

// Reads a classical MAPF instance from the first `agents` rows of a scenario. The agents have the
// ids a0, a1, ..., and there are no tasks.
LoadedInstance read_scenario_instance(const std::filesystem::path& scenario,
                                      const std::filesystem::path& map, int agents,
                                      const InputRules& rules = {});

// Writes a classical MAPF instance as a scenario with one row per agent, atomically. `map` is the
// file name of the map in each row. The length column has the 4-connected distance (see
// write_scenario()). Throws NotRepresentable if the map is a roadmap, there are tasks, an agent's
// turns take time, a destination is missing or unreachable, or the ids of agents are not the
// default ids. Throws InputError if the file cannot be written or `map` contains blanks.
void write_scenario_instance(const std::filesystem::path& path, const Instance& instance,
                             const std::string& map);

// Returns `instance` as the text of a *.cts.json file. If `map` is empty, the text names no map, as
// parse_instance_on() requires.
std::string instance_text(const Instance& instance, const std::string& map);
// Writes `instance` as a *.cts.json file, atomically. `map` is written unchanged and should be a
// path relative to the file. Throws InputError if the file cannot be written.
void write_instance(const std::filesystem::path& path, const Instance& instance,
                    const std::string& map, Durability durability = Durability::kMachine);

}  // namespace grove::detail
