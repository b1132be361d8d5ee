// SPDX-License-Identifier: MIT
// grove convert INSTANCE OUT, grove convert --plan PLAN INSTANCE OUT
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <system_error>

#include "commands.h"
#include "convert_formats.h"
#include "generate_commands.h"
#include "grove/io/atomic_file.h"
#include "grove/io/expressible.h"
#include "grove/io/input_error.h"
#include "grove/io/libmrp_file.h"
#include "grove/io/map_file.h"
#include "grove/io/mapfw_file.h"
#include "grove/io/plan_export.h"
#include "grove/io/plan_file.h"
#include "grove/io/scenario_file.h"
#include "grove/io/tracker_file.h"
#include "grove/model/check.h"
#include "instance_arguments.h"
#include "options.h"

namespace grove {
namespace {

namespace fs = std::filesystem;

constexpr IntegerRange kRowCounts{1, 1'000'000};

constexpr const char* kFooter =
    "Instances (--from, --to; the suffix tells where one is given):\n"
    "  grove    *.cts.json             Grove's own\n"
    "  libmrp   *.yaml, *.yml          libMultiRobotPlanning: agents with a goal, no tasks\n"
    "  mgcbs                           MGCBS: agents with goals to visit, and no last one "
    "(MG-MAPF).\n"
    "                                  Read as libmrp, too: the keys tell\n"
    "  mapfw    *.mapfw.json           MAPFW: starts, goals and waypoints, which are tasks; no "
    "ids\n"
    "  scen     *.scen                 Moving AI: starts and goals only, no ids\n"
    "Plans (--to, with --plan):\n"
    "  libmrp           *.yaml, *.yml  libMultiRobotPlanning's schedule: [x, y] and t of every "
    "step\n"
    "  mapf-visualizer                 Kei18's text: (x,y) of all agents, one line per time\n"
    "  eecbs                           path lists of EECBS, CBSH2-RTC and MAPF-LNS2: (row,column)\n"
    "  tracker                         a row of MAPF Tracker as JSON; no tasks\n"
    "  tracker-csv      *.csv          the same as CSV\n"
    "\n"
    "What OUT cannot hold is an error, unless --drop gives it up:\n"
    "  tasks   in libmrp and scen: the agents only go from start to goal\n"
    "  ids     in mapfw and scen of agents, in mapfw and mgcbs of tasks: read back they are a0, "
    "a1,\n"
    "          ... and t0, t1, ... as they appear agent by agent\n"
    "Agents without a goal are only for grove and mgcbs, agents with one not for mgcbs.\n"
    "\n"
    "Cells are x, y = column, row from the top left in all formats but eecbs. "
    "libMultiRobotPlanning's\n"
    "own viewer draws y upwards: what it shows is upside down but right.\n"
    "grove and scen need a map file. OUT names the map file of INSTANCE, or of --map; if neither "
    "is\n"
    "there, the map is written beside OUT, as '.' and '@'. The length column of a .scen is the "
    "shortest\n"
    "4-connected distance, where Moving AI's own files give the octile one.\n"
    "A plan is checked before it is converted. Plan formats hold the paths, not the order of "
    "visits.\n"
    "Agents that are done are padded with waits in mapf-visualizer, and in no other format.\n"
    "\n"
    "Examples:\n"
    "  grove convert warehouse.cts.json warehouse.mapfw.json --drop ids\n"
    "  grove convert mapf_simple1.yaml simple.cts.json\n"
    "  grove convert random-32-32-20-even-1.scen --map random-32-32-20.map --agents 50 fifty.yaml\n"
    "  grove convert problem.json --from mapfw problem.cts.json\n"
    "  grove convert --plan warehouse.plan.json warehouse.cts.json warehouse.txt --to "
    "mapf-visualizer";

struct ConvertArguments {
  std::string instance;
  std::string output;
  std::string plan;
  std::string from;
  std::string to;
  std::string map;
  std::string scenario;
  std::int64_t agents = 0;
  std::string drop;
  bool flip_up_down = false;

  bool drops(const std::string& what) const {
    return std::ranges::count(CLI::detail::split(drop, ','), what) > 0;
  }
};

// --- instances in ---

LoadedInstance read_scen(const ConvertArguments& arguments) {
  if (arguments.map.empty()) throw CLI::ValidationError("--map", "required with a .scen INSTANCE");
  const auto rows =
      arguments.agents > 0
          ? static_cast<std::size_t>(arguments.agents)
          : std::min<std::size_t>(read_scenario(arguments.instance).size(), kRowCounts.most);
  return read_scenario_instance(arguments.instance, arguments.map, static_cast<int>(rows));
}

LoadedInstance load(const ConvertArguments& arguments, InstanceFormat from) {
  if (from == InstanceFormat::kGrove) return read_instance(arguments.instance);
  if (from == InstanceFormat::kScen) return read_scen(arguments);
  const auto read = from == InstanceFormat::kMapfw ? read_mapfw_problem : read_libmrp_instance;
  std::vector<std::string> warnings;
  Instance instance = read(arguments.instance, &warnings);
  return {std::move(instance), {}, std::move(warnings)};
}

// Where in a file of format `from` the agent or task stands that `error` is about.
std::string place_of(const InstanceError& error, const Instance& instance, InstanceFormat from) {
  const std::string& field = error.field();
  const std::size_t slash = field.find('/');
  if (slash == std::string::npos) return "/" + field;
  const int index = std::stoi(field.substr(slash + 1));
  const bool is_task = field.starts_with("tasks");
  switch (from) {
    case InstanceFormat::kGrove:
      return "/" + field;
    case InstanceFormat::kLibmrp:
    case InstanceFormat::kMgcbs:
      return is_task ? fmt::format("/agents/{}/goals", instance.task(index).agents.front())
                     : "/" + field;
    case InstanceFormat::kMapfw:
      return is_task ? fmt::format("/waypoints/{}", instance.task(index).agents.front())
                     : fmt::format("/starts/{}", index);
    case InstanceFormat::kScen:
      return fmt::format("line {}", index + 2);
  }
  return "/" + field;
}

std::string hint(Loss loss) {
  if (loss == Loss::kIds) return " (--drop ids gives the ids up)";
  return loss == Loss::kTasks ? " (--drop tasks gives the tasks up)" : "";
}

// Runs `write`; says where in INSTANCE it is that OUT cannot hold.
template <typename Write>
void express(const ConvertArguments& arguments, const Instance& instance, InstanceFormat from,
             Write write) {
  try {
    write();
  } catch (const NotExpressible& error) {
    throw InputError(arguments.instance, place_of(error, instance, from),
                     error.what() + hint(error.loss()));
  } catch (const InstanceError& error) {
    throw InputError(arguments.instance, place_of(error, instance, from), error.what());
  }
}

// --- instances out ---

bool same_map(const Grid& a, const Grid& b) {
  if (a.width() != b.width() || a.height() != b.height()) return false;
  for (Cell cell = 0; cell < a.cell_count(); ++cell)
    if (a.passable(cell) != b.passable(cell)) return false;
  return true;
}

void require_map_of_instance(const std::string& map, const ConvertArguments& arguments,
                             const Instance& instance) {
  if (!same_map(read_map(map), instance.grid()))
    throw InputError(
        map, "",
        fmt::format("is another map than that of '{}'; expected the same {} x {} "
                    "cells, passable and blocked alike",
                    arguments.instance, instance.grid().width(), instance.grid().height()));
}

// The map file that OUT names.
struct OutputMap {
  std::string path;
  bool is_new = false;
};

OutputMap choose_map(const ConvertArguments& arguments, const LoadedInstance& loaded) {
  if (!arguments.map.empty()) {
    require_map_of_instance(arguments.map, arguments, loaded.instance);
    return {arguments.map};
  }
  if (!loaded.map_path.empty()) return {loaded.map_path.string()};
  const OutputMap beside{without_suffix(arguments.output) + ".map", true};
  std::error_code ignored;
  if (!fs::exists(fs::symlink_status(beside.path, ignored))) return beside;
  require_map_of_instance(beside.path, arguments, loaded.instance);  // nobody's map is overwritten
  return {beside.path};
}

Instance reduced(const Instance& instance, const ConvertArguments& arguments, InstanceFormat to) {
  const bool drops_tasks = arguments.drops("tasks") && !holds_tasks(to);
  const bool has_agent_ids = to != InstanceFormat::kMapfw && to != InstanceFormat::kScen;
  const bool has_task_ids = to == InstanceFormat::kGrove;
  Instance result = drops_tasks ? without_tasks(instance) : instance;
  if (!arguments.drops("ids")) return result;
  if (!has_task_ids) result = with_default_task_ids(result);
  return has_agent_ids ? result : with_default_agent_ids(result);
}

void write_naming_map(const ConvertArguments& arguments, const LoadedInstance& loaded,
                      const Instance& instance, InstanceFormat to) {
  const OutputMap map = choose_map(arguments, loaded);
  require_distinct_files(arguments.output, map.path, "the map");
  require_writable(arguments.output);
  if (map.is_new) write_map(map.path, instance.grid());
  try {
    if (to == InstanceFormat::kScen)
      write_scenario_instance(arguments.output, instance, fs::path(map.path).filename().string());
    else
      write_instance(arguments.output, instance, map_as_seen_from(arguments.output, map.path));
  } catch (...) {
    std::error_code ignored;
    if (map.is_new) fs::remove(map.path, ignored);
    throw;
  }
  if (map.is_new)
    fmt::print("wrote {}: {} x {} cells\n", map.path, instance.grid().width(),
               instance.grid().height());
}

void write_as(const ConvertArguments& arguments, const LoadedInstance& loaded,
              const Instance& instance, InstanceFormat to) {
  switch (to) {
    case InstanceFormat::kGrove:
    case InstanceFormat::kScen:
      return write_naming_map(arguments, loaded, instance, to);
    case InstanceFormat::kLibmrp:
      return write_libmrp_instance(arguments.output, instance);
    case InstanceFormat::kMgcbs:
      return write_mgcbs_instance(arguments.output, instance);
    case InstanceFormat::kMapfw:
      return write_mapfw_problem(arguments.output, instance);
  }
}

void convert_instance(const ConvertArguments& arguments, InstanceFormat from, InstanceFormat to) {
  const LoadedInstance loaded = load(arguments, from);
  print_warnings(loaded.warnings);
  require_distinct_files(arguments.output, loaded.map_path, "the map");
  express(arguments, loaded.instance, from, [&] {
    const Instance instance = reduced(loaded.instance, arguments, to);
    write_as(arguments, loaded, instance, to);
    fmt::print("wrote {}: {} agents, {} tasks\n", arguments.output, instance.agent_count(),
               instance.task_count());
  });
}

// --- plans out ---

TrackerScenario tracker_scenario(const ConvertArguments& arguments, const LoadedInstance& loaded) {
  require_tracker_instance(loaded.instance);
  if (loaded.map_path.empty())
    throw CLI::ValidationError(
        "--to",
        "a row of MAPF Tracker names a map of Moving AI; expected an INSTANCE with a map file");
  const std::string map = loaded.map_path.stem().string();
  std::string scenario = arguments.scenario;
  const std::string name = fs::path(arguments.instance).stem().string();
  if (scenario.empty() && arguments.instance.ends_with(".scen") && name.starts_with(map + "-"))
    scenario = name.substr(map.size() + 1);
  if (const auto found = parse_tracker_scenario(map, scenario)) return *found;
  throw CLI::ValidationError(
      "--scenario", scenario.empty()
                        ? "required; expected even-N or random-N: the scenario whose first "
                          "rows are the agents"
                        : fmt::format("found '{}'; expected even-N or random-N", scenario));
}

void write_plan_as(const ConvertArguments& arguments, const LoadedInstance& loaded,
                   const Solution& solution, PlanFormat to) {
  const Instance& instance = loaded.instance;
  const fs::path map = loaded.map_path.empty()
                           ? fs::path(without_suffix(arguments.instance) + ".map")
                           : loaded.map_path;
  switch (to) {
    case PlanFormat::kLibmrp:
      return write_libmrp_schedule(arguments.output, instance, solution);
    case PlanFormat::kVisualizer:
      return write_visualizer_text(arguments.output, instance, solution, map.filename().string());
    case PlanFormat::kEecbs:
      return write_path_lists(arguments.output, instance, solution);
    case PlanFormat::kTracker:
    case PlanFormat::kTrackerCsv:
      return write_tracker_row(
          arguments.output, instance, solution, tracker_scenario(arguments, loaded),
          to == PlanFormat::kTracker ? TrackerLayout::kJson : TrackerLayout::kCsv,
          arguments.flip_up_down ? TrackerUp::kAwayFromRowZero : TrackerUp::kTowardsRowZero);
  }
}

void convert_plan(const ConvertArguments& arguments, InstanceFormat from, PlanFormat to) {
  const LoadedInstance loaded = load(arguments, from);
  print_warnings(loaded.warnings);
  std::vector<std::string> warnings;
  const Solution solution = read_solution(arguments.plan, loaded.instance, &warnings);
  print_warnings(warnings);
  const auto violations = check(loaded.instance, solution, 1);
  if (!violations.empty())
    throw InputError(arguments.plan, violations.front().place, violations.front().message);
  require_distinct_files(arguments.output, loaded.map_path, "the map");
  express(arguments, loaded.instance, from,
          [&] { write_plan_as(arguments, loaded, solution, to); });
  fmt::print("wrote {}: {} paths, cost {}\n", arguments.output, loaded.instance.agent_count(),
             solution.plan->cost);
}

// --- the command ---

// Options that do nothing are mistakes.
void require_use(bool given, bool used, const std::string& option, const std::string& when) {
  if (given && !used) throw CLI::ValidationError(option, "expected only with " + when);
}

void require_known_drops(const std::string& drop) {
  if (drop.empty()) return;
  for (const std::string& what : CLI::detail::split(drop, ','))
    if (what != "ids" && what != "tasks")
      throw CLI::ValidationError("--drop",
                                 fmt::format("found '{}'; expected ids, tasks or ids,tasks", what));
}

void run(const ConvertArguments& arguments) {
  require_known_drops(arguments.drop);
  const bool is_plan = !arguments.plan.empty();
  const InstanceFormat from = instance_format("--from", arguments.from, arguments.instance);
  const bool is_scen = from == InstanceFormat::kScen;
  require_use(arguments.agents > 0, is_scen, "--agents", "a .scen INSTANCE");
  require_use(!arguments.drop.empty(), !is_plan, "--drop", "instances, not with --plan");
  require_distinct_files(arguments.output, arguments.instance, "the instance");
  require_distinct_files(arguments.output, arguments.plan, "the plan");
  if (is_plan) {
    const PlanFormat to = plan_format("--to", arguments.to, arguments.output);
    const bool is_tracker = to == PlanFormat::kTracker || to == PlanFormat::kTrackerCsv;
    require_use(!arguments.map.empty(), is_scen, "--map", "a .scen INSTANCE");
    require_use(!arguments.scenario.empty(), is_tracker, "--scenario", "--to tracker");
    require_use(arguments.flip_up_down, is_tracker, "--flip-up-down", "--to tracker");
    return convert_plan(arguments, from, to);
  }
  const InstanceFormat to = instance_format("--to", arguments.to, arguments.output);
  require_use(!arguments.map.empty(), is_scen || names_a_map(to), "--map",
              "a .scen INSTANCE, or an OUT with a map");
  require_use(!arguments.scenario.empty(), false, "--scenario", "--plan and --to tracker");
  require_use(arguments.flip_up_down, false, "--flip-up-down", "--plan and --to tracker");
  convert_instance(arguments, from, to);
}

void add_options(CLI::App& command, ConvertArguments& arguments) {
  command.add_option("INSTANCE", arguments.instance, "instance to read")->required()->type_name("");
  command.add_option("OUT", arguments.output, "file to write, whole or not at all")
      ->required()
      ->type_name("");
  command
      .add_option("--plan", arguments.plan,
                  "convert this plan file of INSTANCE, not INSTANCE itself")
      ->type_name("PLAN");
  command.add_option("--from", arguments.from, "format of INSTANCE")->type_name("FORMAT");
  command.add_option("--to", arguments.to, "format of OUT")->type_name("FORMAT");
  command
      .add_option(
          "--map", arguments.map,
          "map of a .scen INSTANCE; else the map file that OUT is to name, with the same map")
      ->type_name("FILE.map");
  add_integer(command, "--agents", arguments.agents, kRowCounts,
              "the first N rows of a .scen INSTANCE, not all")
      ->default_str("");
  command
      .add_option("--drop", arguments.drop, "give up what OUT cannot hold: ids, tasks or ids,tasks")
      ->type_name("WHAT");
  command
      .add_option("--scenario", arguments.scenario,
                  "with --to tracker: the scenario whose first rows are the agents, even-N or "
                  "random-N (default: what the name of a .scen INSTANCE tells)")
      ->type_name("TYPE-N");
  command.add_flag("--flip-up-down", arguments.flip_up_down,
                   "with --to tracker: u for y + 1, as in the tracker's downloads; its documents "
                   "say y - 1. Send one small plan first");
}

}  // namespace

void add_convert_command(CLI::App& app) {
  const auto arguments = std::make_shared<ConvertArguments>();
  CLI::App* command =
      app.add_subcommand("convert", "Instances and plans in the formats of other tools");
  command->footer(kFooter);
  add_options(*command, *arguments);
  command->callback([arguments] { run(*arguments); });
}

}  // namespace grove
