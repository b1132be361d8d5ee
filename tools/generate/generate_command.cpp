// SPDX-License-Identifier: MIT
// grove generate: the command itself, and functions that its subcommands share.
#include <fmt/format.h>

#include "io/map_file.h"
#include "tools/common/commands.h"
#include "tools/common/instance_arguments.h"
#include "tools/generate/generate_commands.h"
#include "tools/generate/scenario_generator.h"

namespace grove::detail {
namespace {

constexpr const char* kFooter =
    R"(All random choices depend only on --seed: the same command writes the same bytes on every
machine.

Examples:
  grove generate map random --width 32 --height 32 --obstacles 0.2 --seed 1 -o my.map
  grove generate scenario --map my.map --rows 200 --seed 1 -o my.scen
  grove generate instance --map my.map --scen my.scen --agents 10 --tasks 30 -o my.cts.json
  grove generate instance --map my.map --agents 5 --tasks 10 --mg -o my_mg.cts.json
  grove generate roadmap --kind warehouse -o depot.roadmap.json
  grove generate instance --roadmap depot.roadmap.json --tasks-on a --agents 100 --tasks 300 \
        -o depot.cts.json
  grove generate dataset --map my.map --scen my.scen --agents 5,10,20 --tasks 10,30,50 \
        --output-dir my_set
  grove generate paper --scenarios 1-5 --output-dir paper)";

}  // namespace

void add_output(CLI::App& command, std::string& path, const std::string& type_name) {
  command.add_option("-o,--output", path, "file to write, completely or not at all")
      ->required()
      ->type_name(type_name);
}

Grid load_map(const std::string& map) {
  std::vector<std::string> warnings;
  Grid grid = read_map(map, &warnings);
  print_warnings(warnings);
  return grid;
}

Scenario load_scenario(const std::string& file, const std::string& map, const Grid& grid) {
  Scenario scenario{file, read_scenario(file)};
  require_same_map(file, scenario.rows, map, grid);
  return scenario;
}

Scenario draw_scenario(const std::string& map, const Grid& grid, const InstanceRequest& request,
                       std::int64_t seed) {
  return {map,
          random_scenario(grid, map, rows_needed(request), static_cast<std::uint64_t>(seed),
                          fmt::format("{} agents and {} tasks", request.agents, request.tasks))};
}

std::string map_as_seen_from(const std::filesystem::path& instance, const std::string& map) {
  namespace fs = std::filesystem;
  const fs::path directory = fs::absolute(instance).parent_path();
  return fs::proximate(fs::absolute(map), directory).generic_string();
}

void add_generate_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("generate", "Generate maps, roadmaps, scenarios, instances and data sets");
  command->footer(kFooter)->require_subcommand(1);
  add_generate_map_command(*command);
  add_generate_roadmap_command(*command);
  add_generate_scenario_command(*command);
  add_generate_instance_command(*command);
  add_generate_dataset_command(*command);
  add_generate_paper_command(*command);
}

}  // namespace grove::detail
