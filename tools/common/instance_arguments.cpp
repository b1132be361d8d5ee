// SPDX-License-Identifier: MIT
#include "tools/common/instance_arguments.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string_view>

#include "grove/detail/io/input_error.h"
#include "grove/detail/io/scenario_file.h"
#include "grove/detail/io/text_file.h"
#include "tools/common/file_formats.h"
#include "tools/common/options.h"
#include "tools/common/standard_error.h"

namespace grove::detail {
namespace {

constexpr IntegerRange kAgentCounts{1, 1'000'000};
constexpr std::string_view kScenario = ".scen";

}  // namespace

void InstanceArguments::add_to(CLI::App& command) {
  command
      .add_option("INSTANCE", path_,
                  "instance: FILE.cts.json, - for one on standard input (its map is relative to "
                  "this directory), or FILE.scen with --agents")
      ->required()
      ->type_name("");
  command
      .add_option("--map", map_, "map of a .scen file; by default the one beside it that it names")
      ->type_name("FILE.map");
  add_integer(command, "--agents", agents_, kAgentCounts, "the first N rows of a .scen file")
      ->default_str("");
}

void InstanceArguments::add_rules_to(CLI::App& command) {
  command.add_flag("--no-following", no_following_,
                   "nobody enters a place in the step in which another leaves it: robots that hold "
                   "a place until "
                   "they have left it drive such a plan as it stands, without rings (see 'grove "
                   "execute --help')");
}

std::string InstanceArguments::name() const {
  return is_standard_input() ? "standard input" : path_;
}

std::string InstanceArguments::stem() const {
  if (is_standard_input()) return "stdin";
  const std::string name = std::filesystem::path(path_).filename().string();
  for (const std::string_view suffix : {".cts.json", ".json"})
    if (name.ends_with(suffix)) return name.substr(0, name.size() - suffix.size());
  if (!name.ends_with(kScenario)) return name;
  return fmt::format("{}-{}", name.substr(0, name.size() - kScenario.size()), agents_);
}

LoadedInstance InstanceArguments::read() const {
  if (path_.ends_with(kScenario)) return read_first_rows();
  if (!map_.empty() || agents_ > 0)
    throw CLI::ValidationError("--map, --agents", "expected only with a .scen file");
  if (is_standard_input())
    return parse_instance(standard_input_ ? *standard_input_ : read_standard_input(), name(), ".");
  if (path_.ends_with(".map"))
    throw InputError(
        path_, "", "a map; expected an instance, FILE.cts.json, which names its map, or FILE.scen");
  if (path_.ends_with(".roadmap.json"))
    throw InputError(path_, "",
                     "a roadmap; expected an instance, FILE.cts.json, which names its roadmap "
                     "('grove generate instance' makes one)");
  if (path_.ends_with(".graphml") || path_.ends_with(".lif.json"))
    throw InputError(path_, "",
                     "a road network of another tool; expected an instance, FILE.cts.json, on the "
                     "roadmap that 'grove convert' makes of it");
  if (is_called_like_another_tools_instance(path_))
    throw InputError(path_, "",
                     "an instance of another tool; expected FILE.cts.json, which 'grove convert' "
                     "makes of it");
  return read_instance(path_);
}

LoadedInstance InstanceArguments::read_first_rows() const {
  if (agents_ == 0) throw CLI::ValidationError("--agents", "required with a .scen file");
  const std::filesystem::path map = map_.empty() ? map_beside(path_) : std::filesystem::path(map_);
  if (map.empty())
    throw CLI::ValidationError(
        "--map", "required with a .scen file that does not lie beside the map that it names");
  return read_scenario_instance(path_, map, static_cast<int>(agents_));
}

LoadedInstance InstanceArguments::load(bool speaks) const {
  LoadedInstance loaded = read();
  if (no_following_) loaded.instance = loaded.instance.without_following();
  if (speaks) print_warnings(loaded.warnings);
  return loaded;
}

std::string read_standard_input() {
  return read_text("/dev/stdin");
}

void print_warnings(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) say_on_stderr("grove: warning: " + warning);
}

}  // namespace grove::detail
