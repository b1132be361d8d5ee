// SPDX-License-Identifier: MIT
// grove generate paper: the paper's data set (section V), with a manifest.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <numeric>

#include "batch/folder.h"
#include "io/input_error.h"
#include "io/map_file.h"
#include "tools/generate/choices_arguments.h"
#include "tools/generate/extras_arguments.h"
#include "tools/generate/generate_commands.h"
#include "tools/generate/generate_set.h"
#include "tools/generate/map_generator.h"

namespace grove::detail {
namespace {

namespace fs = std::filesystem;

constexpr int kScenarios = 50;

constexpr const char* kPaperFooter =
    R"(Without further options: 3 maps, 50 scenarios, 5, 10 and 20 agents, 10 to 50 tasks, with and
without destinations: 4,500 instances, and DIR/manifest.txt, which lists them for 'grove bench'.
Files are named MAP_sS_nN_mM.cts.json, with the suffix _mg without destinations. manifest-cts.txt
and manifest-mg.txt list the instances with and without destinations, for methods that support only
one of the problems.

With --turning or --durations the same instances are made for robots that need time to turn, and
for tasks that take time; the file names show it: MAP_sS_nN_mM_turning_d0-10.cts.json.

With --need the same instances are made with tasks for any K agents: _needK, or _needKofN with
--eligible N. With --problem cts, agents may choose their destinations: _anygoal, _goalsK
(--goal-choices K) or _groupsG (--goal-groups G). A share below 1 follows in percent: _need1-50pc.

With --movingai the maps and scenarios are those of the Moving AI benchmark, in one folder: MAP.map,
scenarios 1 to 25 from MAP-random-1.scen to MAP-random-25.scen, 26 to 50 from MAP-even-1.scen to
MAP-even-25.scen. Without it Grove generates maps of the same kinds (empty, random and rooms, 32 x
32 cells), writes them to DIR, and draws the scenarios.

An instance of scenario K is the one that 'grove generate instance' makes from it with the seed K
plus --seed.

Examples:
  grove generate paper --movingai mapf/ --scenarios 1-25 --output-dir paper
  grove generate paper --scenarios 1-3 --agents 5 --problem cts --output-dir small
  grove generate paper --scenarios 1-3 --need 1 --need-share 0.5 --output-dir half
  grove generate paper --movingai mapf/ --maps den312d --scenarios 1-5 --agents 10,50,100 \
        --tasks 0 --problem cts --any-goal --output-dir targets
  grove bench small/manifest.txt --run 'paper: --policy fixed' --run 'grove:' --output-dir results)";

// Values of --problem, each with the problems that it generates: false is CTS-MAPF (agents have
// destinations), true is MG-MAPF (agents have none).
const std::map<std::string, std::vector<bool>> kProblems{
    {"both", {false, true}}, {"cts", {false}}, {"mg", {true}}};

struct PaperArguments {
  std::string movingai;
  std::vector<std::string> maps{"empty-32-32", "random-32-32-20", "room-32-32-4"};
  std::vector<std::int64_t> scenarios;
  std::vector<std::int64_t> agents{5, 10, 20};
  std::vector<std::int64_t> tasks{10, 20, 30, 40, 50};
  std::string problem = "both";
  std::int64_t seed = 0;
  ExtrasArguments extras;
  ChoicesArguments choices;
  std::string output_dir;
};

// --- Moving AI's maps ---

constexpr std::int64_t kScenariosPerKind = 25;

fs::path scenario_file(const PaperArguments& arguments, const std::string& map, std::int64_t k) {
  return fs::path(arguments.movingai) /
         (k <= kScenariosPerKind ? fmt::format("{}-random-{}.scen", map, k)
                                 : fmt::format("{}-even-{}.scen", map, k - kScenariosPerKind));
}

// Throws InputError if a scenario file is missing. Checks all files first, because benchmarks are
// often downloaded only in part; the error lists the scenarios that exist for all maps.
void require_scenarios(const PaperArguments& arguments) {
  std::string missing;
  std::vector<std::int64_t> there;
  for (const std::int64_t k : arguments.scenarios) {
    const auto without_k = std::ranges::find_if_not(arguments.maps, [&](const std::string& map) {
      return fs::exists(scenario_file(arguments, map, k));
    });
    if (without_k == arguments.maps.end())
      there.push_back(k);
    else if (missing.empty())
      missing = scenario_file(arguments, *without_k, k).string();
  }
  if (missing.empty()) return;
  throw InputError(missing, "",
                   fmt::format("does not exist; expected it{}",
                               there.empty() ? "" : ", or --scenarios " + ranges_text(there)));
}

MapSet load_map_set(const PaperArguments& arguments, const std::string& name) {
  if (std::ranges::count(arguments.maps, name) > 1)
    throw CLI::ValidationError(
        "--maps", fmt::format("found '{}' more than once; expected distinct names", name));
  const std::string map = (fs::path(arguments.movingai) / (name + ".map")).string();
  return {map, load_map(map), {}};
}

void load_scenarios(const PaperArguments& arguments, const std::string& name, MapSet& set) {
  for (const std::int64_t k : arguments.scenarios) {
    const std::string file = scenario_file(arguments, name, k).string();
    set.scenarios.push_back(
        {std::to_string(k), load_scenario(file, set.map, set.grid), arguments.seed + k});
  }
}

std::vector<MapSet> load_map_sets(const PaperArguments& arguments) {
  if (std::ranges::max(arguments.scenarios) > 2 * kScenariosPerKind)
    throw CLI::ValidationError("--scenarios",
                               "found more than 50 with --movingai; expected at most 50");
  std::vector<MapSet> sets;
  for (const std::string& name : arguments.maps) sets.push_back(load_map_set(arguments, name));
  require_scenarios(arguments);
  for (std::size_t i = 0; i < sets.size(); ++i)
    load_scenarios(arguments, arguments.maps[i], sets[i]);
  return sets;
}

// --- generated maps, identical to those in benchmarks/data ---

constexpr int kSide = 32;
constexpr int kMapSeed = 1;

MapSet draw_map_set(const PaperArguments& arguments, const std::string& name, Grid grid) {
  const std::string map = (fs::path(arguments.output_dir) / (name + ".map")).string();
  const InstanceRequest largest{.agents = static_cast<int>(std::ranges::max(arguments.agents)),
                                .tasks = static_cast<int>(std::ranges::max(arguments.tasks))};
  MapSet set{map, std::move(grid), {}};
  for (const std::int64_t k : arguments.scenarios) {
    const std::int64_t seed = arguments.seed + k;
    set.scenarios.push_back({std::to_string(k), draw_scenario(map, set.grid, largest, seed), seed});
  }
  return set;
}

std::vector<MapSet> draw_map_sets(const PaperArguments& arguments) {
  return {draw_map_set(arguments, "empty-32x32", empty_map(kSide, kSide)),
          draw_map_set(arguments, "random-32x32-20", random_map(kSide, kSide, 0.2, kMapSeed)),
          draw_map_set(arguments, "rooms-32x32", rooms_map(kSide, kSide, 4, 0.9, kMapSeed))};
}

void run(const CLI::App& app, const PaperArguments& arguments) {
  const Extras extras = arguments.extras.extras(arguments.problem != "mg");
  const Choices choices = arguments.choices.choices(std::ranges::min(arguments.agents),
                                                    arguments.problem == "cts");
  const bool draws = arguments.movingai.empty();
  if (draws && app.count("--maps") > 0)
    throw CLI::ValidationError("--maps", "allowed only with --movingai");
  const std::vector<MapSet> maps = draws ? draw_map_sets(arguments) : load_map_sets(arguments);
  const SetSizes sizes{arguments.agents, arguments.tasks, kProblems.at(arguments.problem), extras,
                       choices};
  require_fitting(maps, sizes);
  batch::make_folder(arguments.output_dir);
  if (draws)
    for (const MapSet& set : maps) write_map(set.map, set.grid);
  write_set(arguments.output_dir, maps, sizes);
}

}  // namespace

void add_generate_paper_command(CLI::App& generate) {
  const auto arguments = std::make_shared<PaperArguments>();
  arguments->scenarios.resize(kScenarios);
  std::iota(arguments->scenarios.begin(), arguments->scenarios.end(), 1);
  CLI::App* command =
      generate.add_subcommand("paper", "Generate the paper's data set, or a part of it");
  command->footer(kPaperFooter);
  command
      ->add_option("--movingai", arguments->movingai,
                   "folder with maps and scenarios of Moving AI; default: generate them")
      ->type_name("DIR");
  command->add_option("--maps", arguments->maps, "with --movingai: names of the maps")
      ->type_name("NAME,...")
      ->delimiter(',')
      ->default_str("empty-32-32,random-32-32-20,room-32-32-4");
  add_ranges(*command, "--scenarios", arguments->scenarios, kScenarioNumbers, "1-50",
             "numbers of scenarios");
  add_integers(*command, "--agents", arguments->agents, kAgentNumbers, "numbers of agents")
      ->default_str("5,10,20");
  add_integers(*command, "--tasks", arguments->tasks, kTaskNumbers, "numbers of tasks")
      ->default_str("10,20,30,40,50");
  command
      ->add_option("--problem", arguments->problem,
                   "problem: with destinations (cts: CTS-MAPF), without (mg: MG-MAPF), or both")
      ->type_name("cts|mg|both")
      ->check(one_of({"both", "cts", "mg"}))
      ->capture_default_str();
  add_integer(*command, "--seed", arguments->seed, {0, 1'000'000'000}, "seed of the data set");
  arguments->extras.add_to(*command);
  arguments->choices.add_to(*command);
  command
      ->add_option("--output-dir", arguments->output_dir, "folder to write to; created if missing")
      ->required()
      ->type_name("DIR");
  command->callback([command, arguments] { run(*command, *arguments); });
}

}  // namespace grove::detail
