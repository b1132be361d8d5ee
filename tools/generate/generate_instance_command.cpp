// SPDX-License-Identifier: MIT
// grove generate scenario and grove generate instance.
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "io/atomic_file.h"
#include "io/instance_file.h"
#include "io/roadmap_file.h"
#include "tools/generate/choices_arguments.h"
#include "tools/generate/extras_arguments.h"
#include "tools/generate/generate_commands.h"
#include "tools/generate/roadmap_instance.h"
#include "tools/generate/scenario_generator.h"

namespace grove::detail {
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
  const std::vector<ScenarioRow> rows = random_scenario(
      grid, arguments.map, static_cast<int>(arguments.rows),
      static_cast<std::uint64_t>(arguments.seed), fmt::format("{} scenario rows", arguments.rows));
  require_distinct_files(arguments.output, arguments.map, "the map");
  write_scenario(arguments.output, rows, scenario_lengths(grid, rows));
  fmt::print("wrote {}: {} rows\n", arguments.output, rows.size());
}

constexpr const char* kInstanceFooter =
    R"(On a map, instances are made as in the paper: the first N rows of the scenario are the agents, and
the starts of the rows from 21 on are the tasks (with more than 20 agents: of the rows after the
agents). Each task is given to 1, 2 or 3 random agents. With --mg no agent has a destination; its
destination becomes one more task of that agent. Without --scen a scenario is drawn with the same
seed.

On a roadmap, all is drawn in the largest strongly connected part: distinct starts, distinct goals,
and tasks on distinct vertices where no agent starts, given to agents as above. A robot at rest on a
dead end, such as a parking bay, does not block other robots.

Without options for choices each of the 1, 2 or 3 agents of a task must visit it, and each agent
ends on its own destination. With --need K any K of all agents that can reach the task visit it, or
K of N random ones with --eligible N. With --any-goal, --goal-choices or --goal-groups an agent
chooses its destination. --need-share and --goal-share draw the tasks and the agents with a choice:
a share of 0.5 of 30 tasks is 15 of them. With --mg there are no destinations to choose; --need does
not apply to the task that replaces a destination. Choices change nothing else in the instance.

Examples:
  grove generate instance --map my.map --agents 10 --tasks 30 --seed 1 -o my.cts.json
  grove generate instance --map my.map --agents 10 --tasks 30 --turning --durations 0-10 \
        -o my_turning.cts.json
  grove generate instance --map my.map --agents 12 --tasks 40 --need 1 -o any_robot.cts.json
  grove generate instance --map my.map --agents 50 --tasks 0 --any-goal -o targets.cts.json
  grove generate instance --roadmap depot.roadmap.json --tasks-on a --agents 100 --tasks 300 \
        -o depot.cts.json)";

struct NewInstanceArguments {
  std::string map;
  std::string scenario;
  std::string roadmap;
  std::string agents_on;
  std::string tasks_on;
  std::int64_t agents = 0;
  std::int64_t tasks = 0;
  std::int64_t seed = 0;
  bool mg = false;
  ExtrasArguments extras;
  ChoicesArguments choices;
  std::string output;
};

void require_fitting(const CLI::App& command) {
  if (command.count("--map") + command.count("--roadmap") == 0)
    throw CLI::RequiredError("--map or --roadmap");
  const auto require_only = [&](const std::string& option, const std::string& where) {
    if (command.count(option) > 0)
      throw CLI::ValidationError(option, fmt::format("allowed only {}", where));
  };
  if (command.count("--roadmap") > 0) {
    require_only("--map", "without --roadmap");
    require_only("--scen", "with --map");
    require_only("--turning", "with --map, because only agents on grids have headings");
  } else {
    require_only("--agents-on", "with --roadmap");
    require_only("--tasks-on", "with --roadmap");
  }
}

Instance instance_on_map(const NewInstanceArguments& arguments, const InstanceRequest& request) {
  const Grid grid = load_map(arguments.map);
  const Scenario scenario = arguments.scenario.empty()
                                ? draw_scenario(arguments.map, grid, request, arguments.seed)
                                : load_scenario(arguments.scenario, arguments.map, grid);
  return generate_instance(grid, scenario, request);
}

Instance instance_on_roadmap(const CLI::App& command, const NewInstanceArguments& arguments,
                             const InstanceRequest& request) {
  Site site{arguments.roadmap, read_roadmap(arguments.roadmap)};
  if (command.count("--agents-on") > 0) site.agents_on = arguments.agents_on;
  if (command.count("--tasks-on") > 0) site.tasks_on = arguments.tasks_on;
  return generate_instance(site, request);
}

void run_instance(const CLI::App& command, const NewInstanceArguments& arguments) {
  require_fitting(command);
  const InstanceRequest request{.agents = static_cast<int>(arguments.agents),
                                .tasks = static_cast<int>(arguments.tasks),
                                .seed = static_cast<std::uint64_t>(arguments.seed),
                                .mg = arguments.mg,
                                .extras = arguments.extras.extras(!arguments.mg),
                                .choices =
                                    arguments.choices.choices(arguments.agents, !arguments.mg)};
  const Instance instance = arguments.roadmap.empty()
                                ? instance_on_map(arguments, request)
                                : instance_on_roadmap(command, arguments, request);
  require_distinct_files(arguments.output, arguments.map, "the map");
  require_distinct_files(arguments.output, arguments.scenario, "the scenario");
  require_distinct_files(arguments.output, arguments.roadmap, "the roadmap");
  const std::string& map = arguments.roadmap.empty() ? arguments.map : arguments.roadmap;
  write_instance(arguments.output, instance, map_as_seen_from(arguments.output, map));
  fmt::print("wrote {}: {} agents, {} tasks\n", arguments.output, instance.agent_count(),
             instance.task_count());
}

}  // namespace

void add_generate_scenario_command(CLI::App& generate) {
  const auto arguments = std::make_shared<ScenarioArguments>();
  CLI::App* command =
      generate.add_subcommand("scenario", "Draw random starts and goals on a map, as a .scen file");
  command->footer(
      "Starts are distinct, goals are distinct, and all are in the map's largest connected part, "
      "as\n"
      "in Moving AI's random scenarios. The length column is the 4-connected distance.");
  command->add_option("--map", arguments->map, "map")->required()->type_name("FILE.map");
  add_integer(*command, "--rows", arguments->rows, kRowNumbers, "number of rows");
  add_integer(*command, "--seed", arguments->seed, kSeeds, "seed of all random choices");
  add_output(*command, arguments->output, "FILE.scen");
  command->callback([arguments] { run_scenario(*arguments); });
}

void add_generate_instance_command(CLI::App& generate) {
  const auto arguments = std::make_shared<NewInstanceArguments>();
  CLI::App* command = generate.add_subcommand(
      "instance", "Generate a CTS-MAPF or MG-MAPF instance on a map or a roadmap");
  command->footer(kInstanceFooter);
  command->add_option("--map", arguments->map, "map")->type_name("FILE.map");
  command->add_option("--scen", arguments->scenario, "scenario for this map; default: draw one")
      ->type_name("FILE.scen");
  command->add_option("--roadmap", arguments->roadmap, "roadmap, instead of a map")
      ->type_name("FILE.roadmap.json");
  command
      ->add_option("--agents-on", arguments->agents_on,
                   "with --roadmap: prefix of the ids of vertices where agents start and end; '': "
                   "any vertex; "
                   "default: dead ends, if there are enough")
      ->type_name("PREFIX");
  command
      ->add_option(
          "--tasks-on", arguments->tasks_on,
          "with --roadmap: prefix of the ids of vertices with tasks; '': any vertex; default: "
          "vertices that are not for agents, if agents have vertices of their own")
      ->type_name("PREFIX");
  add_integer(*command, "--agents", arguments->agents, kAgentNumbers, "number of agents")
      ->required()
      ->default_str("");
  add_integer(*command, "--tasks", arguments->tasks, kTaskNumbers, "number of tasks")
      ->required()
      ->default_str("");
  add_integer(*command, "--seed", arguments->seed, kSeeds, "seed of all random choices");
  command->add_flag("--mg", arguments->mg, "make an MG-MAPF instance: agents without destinations");
  arguments->extras.add_to(*command);
  arguments->choices.add_to(*command);
  add_output(*command, arguments->output, "FILE.cts.json");
  command->callback([command, arguments] { run_instance(*command, *arguments); });
}

}  // namespace grove::detail
