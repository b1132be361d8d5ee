// SPDX-License-Identifier: MIT
// grove convert INSTANCE OUT, grove convert --plan PLAN INSTANCE OUT, grove convert ROADS OUT: the
// command line.
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
    R"(Instances (--from, --to; the suffix tells where one is given):
  grove    *.cts.json             Grove's own
  libmrp   *.yaml, *.yml          libMultiRobotPlanning: agents with a goal, no tasks
  mgcbs                           MGCBS: agents with goals to visit, and no last one (MG-MAPF).
                                  Read as libmrp, too: the keys tell
  mapfw    *.mapfw.json           MAPFW: starts, goals and waypoints, which are tasks; no ids
  scen     *.scen                 Moving AI: starts and goals only, no ids
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

A map of ROS becomes cells of --cell-size metres. A cell is blocked where a robot of --robot-radius
in its middle would touch what is not known to be free, and where no straight way leads from it to a
neighbour that is not blocked. The lower left corner of both is the same; what is printed as "where
it lies" brings plans back into its frame.

A plan is checked before it is converted. Plan formats hold the paths, not the order of visits.
Agents that are done are padded with waits in mapf-visualizer and planviz, and in no other format.
waypoints and nav-path are in metres, x to the right and y up: of a grid the middles of cells, of
--cell-size metres each, from --origin on; of a roadmap what it says. A step takes
--seconds-per-step. They are the plan by the clock: robots that may be late need more than that,
'grove execute --order'.

Roads are counted in steps, all rounded up, to 1 at least:
  --metres-per-step D   a robot goes D metres in a step: length / D steps
  --seconds-per-step S  a step lasts S seconds: time / S steps, where an edge's time is the
                        duration the file gives (graphml) or length / maxSpeed (lif); an edge
                        that has none is an error
  both                  the larger of the two: robots go D metres in S seconds, and slower where
                        the file says so. Of an edge without a time D alone counts
The largest rounding is printed, in steps and in percent, with its edge.
graphml: data x and y of nodes (or the middle of yEd's drawing); of edges a length in metres, the
first there is of length, distance, weight, cost, and a time in seconds, of duration, time. Edges
are one way if directed; yEd and DiGraph of networkx call all edges directed.
lif: lengths are those of trajectories, or straight. Edges and nodes that --vehicle-type may not
use, and edges to other layouts, are left out; stations, actions, loads, orientations, heights
are not read. A station's interactionNodeIds are the vertices to name as tasks.
Two opposite one-way edges stay two lanes, on which robots pass one another. If they are one lane
on the floor, as two straight edges of lif mostly are, --merge-lanes makes each pair of as many
steps one two-way road; on that, robots may also turn back.

Examples:
  grove convert warehouse.cts.json warehouse.mapfw.json --drop ids
  grove convert mapf_simple1.yaml simple.cts.json
  grove convert random-32-32-20-even-1.scen --map random-32-32-20.map --agents 50 fifty.yaml
  grove convert problem.json --from mapfw problem.cts.json
  grove convert --plan warehouse.plan.json warehouse.cts.json warehouse.txt --to mapf-visualizer
  grove convert office.yaml office.map --cell-size 0.5 --robot-radius 0.2
  grove convert --plan my.plan.json my.cts.json my.csv --to waypoints --cell-size 0.5 \
        --seconds-per-step 0.8
  grove convert plant.lif.json plant.roadmap.json --metres-per-step 0.5 --merge-lanes)";

// Metres, and seconds, in a step.
constexpr double kLeastScale = 1e-6;
constexpr double kMostScale = 1e6;

// Options that do nothing are mistakes.
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

// Of maps and roads.
void require_no_options_of_instances(const ConvertArguments& arguments) {
  const std::string instances = "instances and plans";
  require_use(!arguments.plan.empty(), false, "--plan", instances);
  require_use(!arguments.map.empty(), false, "--map", instances);
  require_use(arguments.agents > 0, false, "--agents", instances);
  require_use(!arguments.drop.empty(), false, "--drop", instances);
  require_use(!arguments.scenario.empty(), false, "--scenario", instances);
  require_use(arguments.flip_up_down, false, "--flip-up-down", instances);
}

void run_on_maps(const ConvertArguments& arguments) {
  require_no_options_of_instances(arguments);
  require_no_options_of_roads(arguments, false);
  require_distinct_files(arguments.output, arguments.instance, "the map that is read");
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
  if (is_about_maps(arguments)) return run_on_maps(arguments);
  if (is_about_roads(arguments)) return run_on_roads(arguments);
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

void add_options_of_roads(CLI::App& command, ConvertArguments& arguments) {
  add_number(command, "--metres-per-step", arguments.metres_per_step, kLeastScale, kMostScale,
             "roads: how far a robot goes in a step")
      ->type_name("D")
      ->default_str("");
  add_number(command, "--seconds-per-step", arguments.seconds_per_step, kLeastScale, kMostScale,
             "roads: how long a step is; with both, each road takes the larger number of steps. "
             "Plans: the same; by default 1")
      ->type_name("S")
      ->default_str("");
  command.add_option("--layout", arguments.layout, "the layoutId to read, of a LIF with several")
      ->type_name("ID");
  command
      .add_option("--vehicle-type", arguments.vehicle_type,
                  "the vehicleTypeId to read for, of a LIF with several")
      ->type_name("ID");
  command.add_flag("--merge-lanes", arguments.merges_lanes,
                   "two opposite one-way edges of as many steps are one two-way road, a lane that "
                   "robots share, not two lanes");
}

void add_options(CLI::App& command, ConvertArguments& arguments) {
  command.add_option("INSTANCE", arguments.instance, "instance, or roads, to read")
      ->required()
      ->type_name("");
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
  add_confine_option(command, arguments.confined);
  arguments.frame.add_to(command);
  add_number(command, "--robot-radius", arguments.robot_radius, 0, 100,
             "maps of ROS: how far robots keep from walls, in metres")
      ->type_name("METRES");
  add_options_of_roads(command, arguments);
}

}  // namespace

void add_convert_command(CLI::App& app) {
  const auto arguments = std::make_shared<ConvertArguments>();
  CLI::App* command = app.add_subcommand(
      "convert", "Instances, plans, roads and maps in the formats of other tools");
  command->footer(kConvertFooter);
  add_options(*command, *arguments);
  command->callback([arguments] { run(*arguments); });
}

}  // namespace grove::detail
