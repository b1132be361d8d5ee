// SPDX-License-Identifier: MIT
// grove generate scenario, grove generate instance
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "grove/io/atomic_file.h"
#include "grove/io/instance_file.h"
#include "tools/generate/generate_commands.h"
#include "tools/generate/scenario_generator.h"

namespace grove {
namespace {

constexpr IntegerRange kRowNumbers{1, 1'000'000};

struct ScenarioArguments {
  std::string map;
  std::int64_t rows = 1000;
  std::int64_t seed = 0;
  std::string output;
};

void run_scenario(const ScenarioArguments& arguments) {
  const Grid grid = load_map(arguments.map);
  const Scenario scenario =
      draw_scenario(arguments.map, grid, static_cast<int>(arguments.rows), arguments.seed);
  require_distinct_files(arguments.output, arguments.map, "the map");
  write_scenario(arguments.output, scenario.rows, scenario_lengths(grid, scenario.rows));
  fmt::print("wrote {}: {} rows\n", arguments.output, scenario.rows.size());
}

struct NewInstanceArguments {
  std::string map;
  std::string scenario;
  std::int64_t agents = 0;
  std::int64_t tasks = 0;
  std::int64_t seed = 0;
  bool mg = false;
  std::string output;
};

void run_instance(const NewInstanceArguments& arguments) {
  const InstanceRequest request{.agents = static_cast<int>(arguments.agents),
                                .tasks = static_cast<int>(arguments.tasks),
                                .seed = static_cast<std::uint64_t>(arguments.seed),
                                .mg = arguments.mg};
  const Grid grid = load_map(arguments.map);
  const Scenario scenario =
      arguments.scenario.empty()
          ? draw_scenario(arguments.map, grid, rows_needed(request), arguments.seed)
          : load_scenario(arguments.scenario, arguments.map, grid);
  const Instance instance = generate_instance(grid, scenario, request);
  require_distinct_files(arguments.output, arguments.map, "the map");
  require_distinct_files(arguments.output, arguments.scenario, "the scenario");
  write_instance(arguments.output, instance, map_as_seen_from(arguments.output, arguments.map));
  fmt::print("wrote {}: {} agents, {} tasks\n", arguments.output, instance.agent_count(),
             instance.task_count());
}

}  // namespace

void add_generate_scenario_command(CLI::App& generate) {
  const auto arguments = std::make_shared<ScenarioArguments>();
  CLI::App* command =
      generate.add_subcommand("scenario", "Random starts and goals on a map, as a .scen file");
  command->footer(
      "Starts are distinct, goals are distinct, and all lie in the map's largest connected part, "
      "as\n"
      "in Moving AI's random scenarios. The length column is the 4-connected distance.");
  command->add_option("--map", arguments->map, "map")->required()->type_name("FILE.map");
  add_integer(*command, "--rows", arguments->rows, kRowNumbers, "rows to write");
  add_integer(*command, "--seed", arguments->seed, kSeeds, "seed");
  add_output(*command, arguments->output, "FILE.scen");
  command->callback([arguments] { run_scenario(*arguments); });
}

void add_generate_instance_command(CLI::App& generate) {
  const auto arguments = std::make_shared<NewInstanceArguments>();
  CLI::App* command = generate.add_subcommand(
      "instance", "A CTS-MAPF or MG-MAPF instance from a map and perhaps a scenario");
  command->footer(
      "The recipe of the paper: the first N rows of the scenario are the agents; the starts of "
      "the\n"
      "rows from 21 on are the tasks (with more than 20 agents: of the rows after theirs), each\n"
      "given to 1, 2 or 3 random agents. With --mg no agent has a destination: what it was is one\n"
      "more task of that agent. Without --scen a scenario is drawn with the same seed.");
  command->add_option("--map", arguments->map, "map")->required()->type_name("FILE.map");
  command->add_option("--scen", arguments->scenario, "scenario for this map")
      ->type_name("FILE.scen");
  add_integer(*command, "--agents", arguments->agents, kAgentNumbers, "agents")
      ->required()
      ->default_str("");
  add_integer(*command, "--tasks", arguments->tasks, kTaskNumbers, "tasks")
      ->required()
      ->default_str("");
  add_integer(*command, "--seed", arguments->seed, kSeeds, "seed");
  command->add_flag("--mg", arguments->mg, "make an MG-MAPF instance");
  add_output(*command, arguments->output, "FILE.cts.json");
  command->callback([arguments] { run_instance(*arguments); });
}

}  // namespace grove
