// SPDX-License-Identifier: MIT
#include "tools/common/instance_arguments.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <string_view>

#include "io/input_error.h"
#include "io/scenario_file.h"
#include "io/text_file.h"
#include "model/choices.h"
#include "tools/common/file_formats.h"
#include "tools/common/machine.h"
#include "tools/common/options.h"
#include "tools/common/standard_error.h"

namespace grove::detail {
namespace {

constexpr IntegerRange kAgentCounts{1, 1'000'000};
constexpr std::string_view kScenario = ".scen";

}  // namespace

void add_confine_option(CLI::App& command, bool& confined) {
  command.add_flag(
      "--confine", confined,
      "refuse instances that name files outside their own folder, for untrusted input");
}

InputRules input_rules(bool confined, double memory_gb) {
  constexpr double kMaxBytes = 1e18;  // bytes; fits into a size_t
  return {.confined = confined,
          .memory = static_cast<std::size_t>(std::min(memory_gb * 1e9, kMaxBytes))};
}

void InstanceArguments::add_to(CLI::App& command) {
  command
      .add_option("INSTANCE", path_,
                  "instance: FILE.cts.json, - for standard input (its map is relative to "
                  "this directory), or FILE.scen with --agents")
      ->required()
      ->type_name("");
  command
      .add_option("--map", map_,
                  "map of a .scen file; default: the map that it names, if beside it")
      ->type_name("FILE.map");
  add_integer(command, "--agents", agents_, kAgentCounts,
              "number of agents: the first N rows of a .scen file")
      ->default_str("");
  add_confine_option(command, confined_);
}

void InstanceArguments::add_rules_to(CLI::App& command) {
  command.add_flag(
      "--no-following", no_following_,
      "forbid that an agent enters a place in the step in which another one leaves it. "
      "Robots that hold a place until they have left it can execute such a plan "
      "unchanged, and it has no rings (see 'grove execute --help')");
}

void InstanceArguments::require_no_choices(const Instance& instance, std::string_view reason,
                                           std::string_view remedy) const {
  if (const auto choice = find_choice(instance))
    throw InputError(name(), "/" + choice->field, refusal_text(*choice, reason, remedy));
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
    throw CLI::ValidationError("--map, --agents", "allowed only with a .scen file");
  if (is_standard_input())
    return parse_instance(standard_input_ ? *standard_input_ : read_standard_input(), name(), ".",
                          rules());
  if (path_.ends_with(".map"))
    throw InputError(
        path_, "",
        "found a map; expected an instance, FILE.cts.json, which names its map, or FILE.scen");
  if (path_.ends_with(".roadmap.json"))
    throw InputError(
        path_, "",
        "found a roadmap; expected an instance, FILE.cts.json, which names its roadmap "
        "('grove generate instance' makes one)");
  if (path_.ends_with(".graphml") || path_.ends_with(".lif.json"))
    throw InputError(
        path_, "",
        "found a road network of another tool; expected an instance, FILE.cts.json, on the "
        "roadmap that 'grove convert' makes from it");
  if (has_suffix_of_other_format(path_))
    throw InputError(
        path_, "",
        "found an instance of another tool; expected FILE.cts.json, which 'grove convert' "
        "makes from it");
  return read_instance(path_, rules());
}

LoadedInstance InstanceArguments::read_first_rows() const {
  if (agents_ == 0) throw CLI::ValidationError("--agents", "required with a .scen file");
  const std::filesystem::path map =
      map_.empty() ? map_beside(path_, rules()) : std::filesystem::path(map_);
  if (map.empty())
    throw CLI::ValidationError(
        "--map", "required with a .scen file that is not beside the map that it names");
  return read_scenario_instance(path_, map, static_cast<int>(agents_), rules());
}

InputRules InstanceArguments::rules() const {
  return input_rules(confined_, memory_gb_.value_or(default_memory_gb()));
}

LoadedInstance InstanceArguments::load(bool prints_messages) const {
  LoadedInstance loaded = read();
  if (no_following_) loaded.instance = loaded.instance.without_following();
  if (prints_messages) print_warnings(loaded.warnings);
  return loaded;
}

std::string read_standard_input() {
  return read_text("/dev/stdin");
}

void print_warnings(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) print_to_stderr("grove: warning: " + warning);
}

void print_hints(const std::vector<std::string>& hints) {
  for (const std::string& hint : hints) print_to_stderr("grove: hint: " + hint);
}

}  // namespace grove::detail
