// SPDX-License-Identifier: MIT
#include "tools/common/instance_arguments.h"

#include <fmt/format.h>

#include <cstdio>

#include "grove/io/input_error.h"
#include "tools/common/file_formats.h"
#include "tools/common/options.h"
#include "tools/common/standard_error.h"

namespace grove {
namespace {

constexpr IntegerRange kAgentCounts{1, 1'000'000};

}  // namespace

void InstanceArguments::add_to(CLI::App& command) {
  command
      .add_option("INSTANCE", path_,
                  "instance: FILE.cts.json, or FILE.scen with --map and --agents")
      ->required()
      ->type_name("");
  command.add_option("--map", map_, "map of a .scen file")->type_name("FILE.map");
  add_integer(command, "--agents", agents_, kAgentCounts, "the first N rows of a .scen file")
      ->default_str("");
}

LoadedInstance InstanceArguments::read() const {
  const bool is_scenario = path_.ends_with(".scen");
  if (!is_scenario && (!map_.empty() || agents_ > 0))
    throw CLI::ValidationError("--map, --agents", "expected only with a .scen file");
  if (path_.ends_with(".map"))
    throw InputError(
        path_, "", "a map; expected an instance, FILE.cts.json, which names its map, or FILE.scen");
  if (is_called_like_another_tools_instance(path_))
    throw InputError(path_, "",
                     "an instance of another tool; expected FILE.cts.json, which 'grove convert' "
                     "makes of it");
  if (!is_scenario) return read_instance(path_);
  if (map_.empty()) throw CLI::ValidationError("--map", "required with a .scen file");
  if (agents_ == 0) throw CLI::ValidationError("--agents", "required with a .scen file");
  return read_scenario_instance(path_, map_, static_cast<int>(agents_));
}

LoadedInstance InstanceArguments::load(bool speaks) const {
  LoadedInstance loaded = read();
  if (speaks) print_warnings(loaded.warnings);
  return loaded;
}

void print_warnings(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) say_on_stderr("grove: warning: " + warning);
}

}  // namespace grove
