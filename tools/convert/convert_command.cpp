// SPDX-License-Identifier: MIT
// grove convert: the command line. Its forms are grove convert INSTANCE OUT, grove convert --plan
// PLAN INSTANCE OUT, grove convert --fix-choices PLAN INSTANCE OUT, and grove convert ROADS OUT or
// MAP OUT.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "io/input_error.h"
#include "tools/common/commands.h"
#include "tools/common/options.h"
#include "tools/convert/convert_parts.h"

namespace grove::detail {
namespace {

constexpr const char* kConvertFooter =
    R"(Instances (--from, --to; if not given, the suffix determines the format):
  grove    *.cts.json             Grove
  libmrp   *.yaml, *.yml          libMultiRobotPlanning: agents with a goal, no tasks
  potential-goals                 libMultiRobotPlanning's CBS-TA and ITA-CBS: agents with lists of
                                  goals (potentialGoals), of which each takes one; no tasks
  mgcbs                           MGCBS: agents with goals to visit, without a final one (MG-MAPF).
                                  All three are also read as libmrp; the keys determine which
  mapfw    *.mapfw.json           MAPFW: starts, goals and waypoints, which are tasks; no ids
  scen     *.scen                 Moving AI: only starts and goals, no ids
Roads (--from, in place of INSTANCE; OUT is a *.roadmap.json, or --to roadmap):
  graphml  *.graphml              GraphML of networkx, yEd, ...
  lif      *.lif.json             LIF 1, the VDMA's track layouts for VDA 5050
Maps (--from, in place of INSTANCE; OUT is a *.map, or --to map):
  ros      *.yaml, *.yml          an occupancy grid of map_server: map.yaml with its PGM or PNG
  ascii    *.txt                  rows of '. _0' (free) and '#@TX1' (walls)
Plans (--to, with --plan):
  libmrp           *.yaml, *.yml  libMultiRobotPlanning's schedule: [x, y] and t of every step
  mapf-visualizer                 Kei18's text: (x,y) of all agents, one line per time
  eecbs                           path lists of EECBS, CBSH2-RTC and MAPF-LNS2: (row,column)
  tracker                         a row of MAPF Tracker as JSON; no tasks
  tracker-csv      *.csv          the same as CSV
  waypoints                       CSV for robots: seconds, x, y in metres, theta, task
  nav-path                        YAML for ROS: a nav_msgs/Path for each robot
  planviz                         JSON of the League of Robot Runners, for its PlanViz

If the format of OUT cannot express a part of INSTANCE, that is an error, unless --drop leaves that
part out:
  tasks   in libmrp, potential-goals and scen: agents only move from start to goal
  ids     of agents in mapfw and scen, of tasks in mapfw and mgcbs: when read back they are a0, a1,
          ... and t0, t1, ..., numbered agent by agent
Only grove, potential-goals and mgcbs support agents without a goal. mgcbs does not support agents
with one. Only grove and potential-goals support agents that choose their goal, and only grove
supports tasks that need only some of their agents.

Cells are x, y = column, row from the top left in all formats except eecbs. libMultiRobotPlanning's
own viewer draws y upwards, so its picture is mirrored, but correct. In files of ITA-CBS the key
map can name a map file; their cells are read as [row, column].
grove and scen need a map file. OUT names the map file of INSTANCE, or of --map. If there is
neither, the map is written beside OUT, as '.' and '@'. The length column of a .scen is the shortest
4-connected distance; Moving AI's own files have the octile distance.

A map of ROS is converted to cells of --cell-size metres. A cell is blocked if a robot of
--robot-radius at its middle would touch anything that is not known to be free. Of two neighbouring
cells without a straight free path between them, one is blocked, too. Both maps have the same lower left corner.
The line "position" of the output has the options that convert plans back into the frame of the
map.

A plan is checked before it is converted. Plan formats contain the paths, not the order of visits.
In mapf-visualizer and planviz, agents that are done are padded with waits; in other formats not.
waypoints and nav-path are in metres, x to the right and y upwards: on a grid the middles of cells
of --cell-size metres, relative to --origin; on a roadmap its coordinates. A step takes
--seconds-per-step. They describe the plan by the clock. Robots that may be late need the passing
order: 'grove execute --order'.

--fix-choices PLAN: PLAN is a plan of INSTANCE. In OUT each agent must visit the tasks that it visits
in PLAN, and has the goal on which it ends there. An agent without a goal that must visit no task,
and then ends elsewhere than on a task that it has visited, gets its last place as its goal. The
same paths, as a plan of OUT, are written beside OUT: fixed.plan.json for fixed.cts.json.

Lengths and times of roads are converted to steps, rounded up, at least 1:
  --metres-per-step D   a robot moves D metres per step: length / D steps
  --seconds-per-step S  a step lasts S seconds: time / S steps. The time of an edge is the duration
                        in the file (graphml) or length / maxSpeed (lif); an edge without a time
                        is an error
  both                  the larger of the two: robots move D metres in S seconds, or slower if
                        the file says so. For an edge without a time, only D counts
The largest rounding is printed, in steps and in percent, with its edge.
graphml: x and y of nodes (or the middle of yEd's drawing). The length of an edge in metres is the
first present of length, distance, weight, cost; its time in seconds the first of duration, time.
Edges are one way if directed; yEd and DiGraph of networkx declare all edges as directed.
lif: lengths are those of trajectories, or straight. Edges and nodes that --vehicle-type may not
use, and edges to other layouts, are left out. Stations, actions, loads, orientations and heights
are not read. The vertices to name as tasks are a station's interactionNodeIds.
Two opposite one-way edges remain two lanes, on which robots pass one another. If they are one lane
on the floor, as two straight edges of lif usually are, --merge-lanes makes each pair with the same
number of steps one two-way road, on which robots may also turn back.

Examples:
  grove convert warehouse.cts.json warehouse.mapfw.json --drop ids
  grove convert mapf_simple1.yaml simple.cts.json
  grove convert targets.cts.json targets.yaml --to potential-goals
  grove convert random-32-32-20-even-1.scen --map random-32-32-20.map --agents 50 fifty.yaml
  grove convert problem.json --from mapfw problem.cts.json
  grove convert --plan warehouse.plan.json warehouse.cts.json warehouse.txt --to mapf-visualizer
  grove convert any.cts.json fixed.cts.json --fix-choices any.plan.json
  grove convert office.yaml office.map --cell-size 0.5 --robot-radius 0.2
  grove convert --plan my.plan.json my.cts.json my.csv --to waypoints --cell-size 0.5 \
        --seconds-per-step 0.8
  grove convert plant.lif.json plant.roadmap.json --metres-per-step 0.5 --merge-lanes)";

// Range of metres per step and of seconds per step.
constexpr double kMinScale = 1e-6;
constexpr double kMaxScale = 1e6;

// Refuses `option` if it is given but has no effect.
void require_use(bool given, bool used, const std::string& option, const std::string& when) {
  if (given && !used) throw CLI::ValidationError(option, "allowed only with " + when);
}

void require_known_drops(const std::string& drop) {
  if (drop.empty()) return;
  for (const std::string& what : CLI::detail::split(drop, ','))
    if (what != "ids" && what != "tasks")
      throw CLI::ValidationError("--drop",
                                 fmt::format("found '{}'; expected ids, tasks or ids,tasks", what));
}

void require_no_options_of_roads(const ConvertArguments& arguments, bool has_times) {
  const std::string roads = "roads: a *.graphml or *.lif.json INSTANCE, or --from graphml or lif";
  require_use(arguments.metres_per_step > 0, false, "--metres-per-step", roads);
  require_use(arguments.seconds_per_step > 0, has_times, "--seconds-per-step",
              roads + "; or --to waypoints or nav-path");
  require_use(!arguments.layout.empty(), false, "--layout", roads);
  require_use(!arguments.vehicle_type.empty(), false, "--vehicle-type", roads);
  require_use(arguments.merges_lanes, false, "--merge-lanes", roads);
}

// Refuses, for maps and roads, the options that apply only to instances and plans.
void require_no_options_of_instances(const ConvertArguments& arguments) {
  const std::string instances = "instances and plans";
  require_use(!arguments.plan.empty(), false, "--plan", instances);
  require_use(!arguments.fix_choices.empty(), false, "--fix-choices", "instances");
  require_use(!arguments.map.empty(), false, "--map", instances);
  require_use(arguments.agents > 0, false, "--agents", instances);
  require_use(!arguments.drop.empty(), false, "--drop", instances);
  require_use(!arguments.scenario.empty(), false, "--scenario", instances);
  require_use(arguments.flip_up_down, false, "--flip-up-down", instances);
}

void run_on_maps(const ConvertArguments& arguments) {
  require_no_options_of_instances(arguments);
  require_no_options_of_roads(arguments, false);
  require_distinct_files(arguments.output, arguments.instance, "the map to convert");
  convert_map(arguments);
}

void run_on_roads(const ConvertArguments& arguments) {
  require_no_options_of_instances(arguments);
  require_use(arguments.frame.given(), false, "--cell-size, --origin",
              "maps and plans, not with roads");
  require_use(arguments.robot_radius > 0, false, "--robot-radius", "a map of ROS");
  require_distinct_files(arguments.output, arguments.instance, "the roads");
  convert_roadmap(arguments);
}

void run(const ConvertArguments& arguments) {
  if (converts_maps(arguments)) return run_on_maps(arguments);
  if (converts_roads(arguments)) return run_on_roads(arguments);
  require_use(arguments.robot_radius > 0, false, "--robot-radius", "a map of ROS");
  const bool is_plan = !arguments.plan.empty();
  const bool is_driven = is_plan && (arguments.to == "waypoints" || arguments.to == "nav-path");
  require_no_options_of_roads(arguments, is_driven);
  require_use(arguments.frame.given(), is_driven, "--cell-size, --origin",
              "--plan and --to waypoints or nav-path");
  require_known_drops(arguments.drop);
  const InstanceFormat from = instance_format("--from", arguments.from, arguments.instance);
  const bool is_scen = from == InstanceFormat::kScen;
  require_use(arguments.agents > 0, is_scen, "--agents", "a .scen INSTANCE");
  require_use(!arguments.drop.empty(), !is_plan, "--drop", "instances, not with --plan");
  require_distinct_files(arguments.output, arguments.instance, "the instance");
  require_distinct_files(arguments.output, arguments.plan, "the plan");
  require_distinct_files(arguments.output, arguments.fix_choices, "the plan with the choices");
  require_use(!arguments.fix_choices.empty(), !is_plan, "--fix-choices",
              "instances, not with --plan");
  if (is_plan) {
    const PlanFormat to = plan_format("--to", arguments.to, arguments.output);
    const bool is_tracker = to == PlanFormat::kTracker || to == PlanFormat::kTrackerCsv;
    require_use(!arguments.map.empty(), is_scen, "--map", "a .scen INSTANCE");
    require_use(!arguments.scenario.empty(), is_tracker, "--scenario", "--to tracker");
    require_use(arguments.flip_up_down, is_tracker, "--flip-up-down", "--to tracker");
    return convert_plan(arguments, from, to);
  }
  const InstanceFormat to = instance_format("--to", arguments.to, arguments.output);
  require_use(!arguments.map.empty(), is_scen || has_separate_map(to), "--map",
              "a .scen INSTANCE, or an OUT with a map");
  require_use(!arguments.scenario.empty(), false, "--scenario", "--plan and --to tracker");
  require_use(arguments.flip_up_down, false, "--flip-up-down", "--plan and --to tracker");
  if (!arguments.fix_choices.empty()) return convert_choices(arguments, from, to);
  convert_instance(arguments, from, to);
}

void add_options_of_roads(CLI::App& command, ConvertArguments& arguments) {
  add_number(command, "--metres-per-step", arguments.metres_per_step, kMinScale, kMaxScale,
             "roads: distance that a robot moves per step, metres")
      ->type_name("D")
      ->default_str("");
  add_number(command, "--seconds-per-step", arguments.seconds_per_step, kMinScale, kMaxScale,
             "roads: duration of a step, seconds; if both are given, each road takes the larger "
             "number of steps. Plans: duration of a step, seconds; default: 1")
      ->type_name("S")
      ->default_str("");
  command
      .add_option("--layout", arguments.layout, "layoutId to read, for a LIF with several layouts")
      ->type_name("ID");
  command
      .add_option("--vehicle-type", arguments.vehicle_type,
                  "vehicleTypeId to read for, for a LIF with several vehicle types")
      ->type_name("ID");
  command.add_flag(
      "--merge-lanes", arguments.merges_lanes,
      "merge two opposite one-way edges with the same number of steps into one two-way "
      "road: a lane that robots share");
}

void add_options(CLI::App& command, ConvertArguments& arguments) {
  command.add_option("INSTANCE", arguments.instance, "instance or roads to read")
      ->required()
      ->type_name("");
  command.add_option("OUT", arguments.output, "file to write, completely or not at all")
      ->required()
      ->type_name("");
  command
      .add_option("--plan", arguments.plan, "plan file of INSTANCE to convert, instead of INSTANCE")
      ->type_name("PLAN");
  command
      .add_option("--fix-choices", arguments.fix_choices,
                  "plan of INSTANCE whose choices of tasks and goals become fixed in OUT")
      ->type_name("PLAN");
  command.add_option("--from", arguments.from, "format of INSTANCE")->type_name("FORMAT");
  command.add_option("--to", arguments.to, "format of OUT")->type_name("FORMAT");
  command
      .add_option("--map", arguments.map,
                  "map of a .scen INSTANCE; for other formats, the map file for OUT to name, with "
                  "equal cells")
      ->type_name("FILE.map");
  add_integer(command, "--agents", arguments.agents, kRowCounts,
              "number of agents: the first N rows of a .scen INSTANCE; default: all")
      ->default_str("");
  command
      .add_option("--drop", arguments.drop,
                  "leave out what the format of OUT cannot express: ids, tasks or ids,tasks")
      ->type_name("WHAT");
  command
      .add_option(
          "--scenario", arguments.scenario,
          "with --to tracker: scenario whose first rows are the agents, even-N or random-N; "
          "default: from the name of a .scen INSTANCE")
      ->type_name("TYPE-N");
  command.add_flag("--flip-up-down", arguments.flip_up_down,
                   "with --to tracker: write y + 1 as u, as the tracker's downloads do; its "
                   "documentation says y - 1, so submit one small plan first");
  add_confine_option(command, arguments.confined);
  arguments.frame.add_to(command);
  add_number(command, "--robot-radius", arguments.robot_radius, 0, 100,
             "maps of ROS: minimum distance of the middle of a robot from walls, metres")
      ->type_name("METRES");
  add_options_of_roads(command, arguments);
}

}  // namespace

void add_convert_command(CLI::App& app) {
  const auto arguments = std::make_shared<ConvertArguments>();
  CLI::App* command = app.add_subcommand(
      "convert", "Convert instances, plans, roads and maps from and to formats of other tools");
  command->footer(kConvertFooter);
  add_options(*command, *arguments);
  command->callback([arguments] { run(*arguments); });
}

}  // namespace grove::detail
