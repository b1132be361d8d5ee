// SPDX-License-Identifier: MIT
// grove generate dataset: generates instances for every combination of scenario, number of agents
// and number of tasks.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <memory>
#include <set>

#include "io/input_error.h"
#include "tools/generate/choices_arguments.h"
#include "tools/generate/extras_arguments.h"
#include "tools/generate/generate_commands.h"
#include "tools/generate/generate_set.h"

namespace grove::detail {
namespace {

namespace fs = std::filesystem;

constexpr const char* kDatasetFooter =
    R"(Each instance is the one that 'grove generate instance' makes with the same seed. Files are named
MAP_sS_nN_mM.cts.json (S: the number at the end of the scenario's name, N agents, M tasks), with a
suffix for each extra: _turning, or _turningD if a turn takes D > 1 steps, _headings, _dA-B; _needK
or _needKofN, _anygoal, _goalsK, _groupsG, each with its share, if below 1, in percent (-50pc); _mg.
manifest.txt lists them.

Example, the paper's room cells:
  grove generate dataset --map room-32-32-4.map --scen room-32-32-4-random-*.scen \
        --agents 5,10,20 --tasks 10,20,30,40,50 --output-dir room)";

struct DatasetArguments {
  std::string map;
  std::vector<std::string> scenario_files;
  std::int64_t scenarios_to_draw = 1;
  std::vector<std::int64_t> agents;
  std::vector<std::int64_t> tasks;
  std::int64_t seed = 0;
  bool mg = false;
  ExtrasArguments extras;
  ChoicesArguments choices;
  std::string output_dir;
};

// Returns the number at the end of a scenario's file name, "7" for "room-32-32-4-random-7.scen";
// `position` if the name does not end in "-NUMBER".
std::string number_of(const std::string& file, std::size_t position) {
  const std::string stem = fs::path(file).stem().string();
  const auto is_digit = [](unsigned char c) { return std::isdigit(c) != 0; };
  const auto first = std::find_if_not(stem.rbegin(), stem.rend(), is_digit).base();
  const bool ends_in_number = first != stem.end() && first != stem.begin() && *(first - 1) == '-';
  return ends_in_number ? std::string(first, stem.end()) : std::to_string(position);
}

std::vector<NumberedScenario> load_scenarios(const DatasetArguments& arguments, const Grid& grid) {
  std::vector<NumberedScenario> scenarios;
  std::set<std::string> numbers;
  for (const std::string& file : arguments.scenario_files) {
    const std::string number = number_of(file, scenarios.size() + 1);
    if (!numbers.insert(number).second)
      throw InputError(file, "",
                       fmt::format("has the same number {} as another scenario; expected "
                                   "distinct numbers",
                                   number));
    scenarios.push_back({number, load_scenario(file, arguments.map, grid), arguments.seed});
  }
  return scenarios;
}

std::vector<NumberedScenario> draw_scenarios(const DatasetArguments& arguments, const Grid& grid) {
  const InstanceRequest largest{.agents = static_cast<int>(std::ranges::max(arguments.agents)),
                                .tasks = static_cast<int>(std::ranges::max(arguments.tasks))};
  std::vector<NumberedScenario> scenarios;
  for (std::int64_t k = 0; k < arguments.scenarios_to_draw; ++k)
    scenarios.push_back({std::to_string(k + 1),
                         draw_scenario(arguments.map, grid, largest, arguments.seed + k),
                         arguments.seed});
  return scenarios;
}

void run(const DatasetArguments& arguments) {
  const Extras extras = arguments.extras.extras(!arguments.mg);
  const Choices choices =
      arguments.choices.choices(std::ranges::min(arguments.agents), !arguments.mg);
  const Grid grid = load_map(arguments.map);
  const std::vector<MapSet> maps{{arguments.map, grid,
                                  arguments.scenario_files.empty()
                                      ? draw_scenarios(arguments, grid)
                                      : load_scenarios(arguments, grid)}};
  const SetSizes sizes{arguments.agents, arguments.tasks, {arguments.mg}, extras, choices};
  // Checks all combinations before the first file is written, so that no incomplete set remains.
  require_fitting(maps, sizes);
  write_set(arguments.output_dir, maps, sizes);
}

}  // namespace

void add_generate_dataset_command(CLI::App& generate) {
  const auto arguments = std::make_shared<DatasetArguments>();
  CLI::App* command = generate.add_subcommand(
      "dataset", "Generate instances for all combinations of scenarios, agents and tasks");
  command->footer(kDatasetFooter);
  command->add_option("--map", arguments->map, "map")->required()->type_name("FILE.map");
  command->add_option("--scen", arguments->scenario_files, "scenarios for this map")
      ->type_name("FILE.scen");
  add_integer(*command, "--scenarios", arguments->scenarios_to_draw, kScenarioNumbers,
              "without --scen: number of scenarios to draw, the k-th with seed + k - 1");
  add_integers(*command, "--agents", arguments->agents, kAgentNumbers, "numbers of agents")
      ->required();
  add_integers(*command, "--tasks", arguments->tasks, kTaskNumbers, "numbers of tasks")->required();
  add_integer(*command, "--seed", arguments->seed, kSeeds, "seed of all random choices");
  command->add_flag("--mg", arguments->mg, "make MG-MAPF instances: agents without destinations");
  arguments->extras.add_to(*command);
  arguments->choices.add_to(*command);
  command
      ->add_option("--output-dir", arguments->output_dir, "folder to write to; created if missing")
      ->required()
      ->type_name("DIR");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace grove::detail
