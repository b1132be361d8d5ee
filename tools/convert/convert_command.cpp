// SPDX-License-Identifier: MIT
// grove convert INSTANCE OUT, grove convert --plan PLAN INSTANCE OUT: the command line.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "grove/io/input_error.h"
#include "tools/common/commands.h"
#include "tools/common/options.h"
#include "tools/convert/convert_parts.h"

namespace grove {
namespace {

constexpr const char* kConvertFooter =
    R"(Instances (--from, --to; the suffix tells where one is given):
  grove    *.cts.json             Grove's own
  libmrp   *.yaml, *.yml          libMultiRobotPlanning: agents with a goal, no tasks
  mgcbs                           MGCBS: agents with goals to visit, and no last one (MG-MAPF).
                                  Read as libmrp, too: the keys tell
  mapfw    *.mapfw.json           MAPFW: starts, goals and waypoints, which are tasks; no ids
  scen     *.scen                 Moving AI: starts and goals only, no ids
Plans (--to, with --plan):
  libmrp           *.yaml, *.yml  libMultiRobotPlanning's schedule: [x, y] and t of every step
  mapf-visualizer                 Kei18's text: (x,y) of all agents, one line per time
  eecbs                           path lists of EECBS, CBSH2-RTC and MAPF-LNS2: (row,column)
  tracker                         a row of MAPF Tracker as JSON; no tasks
  tracker-csv      *.csv          the same as CSV

What OUT cannot hold is an error, unless --drop gives it up:
  tasks   in libmrp and scen: the agents only go from start to goal
  ids     in mapfw and scen of agents, in mapfw and mgcbs of tasks: read back they are a0, a1,
          ... and t0, t1, ... as they appear agent by agent
Agents without a goal are only for grove and mgcbs, agents with one not for mgcbs.

Cells are x, y = column, row from the top left in all formats but eecbs. libMultiRobotPlanning's
own viewer draws y upwards: what it shows is upside down but right.
grove and scen need a map file. OUT names the map file of INSTANCE, or of --map; if neither is
there, the map is written beside OUT, as '.' and '@'. The length column of a .scen is the shortest
4-connected distance, where Moving AI's own files give the octile one.
A plan is checked before it is converted. Plan formats hold the paths, not the order of visits.
Agents that are done are padded with waits in mapf-visualizer, and in no other format.

Examples:
  grove convert warehouse.cts.json warehouse.mapfw.json --drop ids
  grove convert mapf_simple1.yaml simple.cts.json
  grove convert random-32-32-20-even-1.scen --map random-32-32-20.map --agents 50 fifty.yaml
  grove convert problem.json --from mapfw problem.cts.json
  grove convert --plan warehouse.plan.json warehouse.cts.json warehouse.txt --to mapf-visualizer)";

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
  command->footer(kConvertFooter);
  add_options(*command, *arguments);
  command->callback([arguments] { run(*arguments); });
}

}  // namespace grove
