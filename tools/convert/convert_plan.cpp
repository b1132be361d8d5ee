// SPDX-License-Identifier: MIT
// grove convert --plan: converts a plan to a different format.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>

#include "io/atomic_file.h"
#include "io/input_error.h"
#include "io/plan_export.h"
#include "io/plan_file.h"
#include "io/tracker_file.h"
#include "tools/common/commands.h"
#include "tools/common/instance_arguments.h"
#include "tools/convert/convert_parts.h"

namespace grove::detail {
namespace {

namespace fs = std::filesystem;

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

Scale scale(const ConvertArguments& arguments, const Instance& instance) {
  Scale scale{.frame = arguments.frame.frame(instance)};
  if (arguments.seconds_per_step > 0) scale.seconds_per_step = arguments.seconds_per_step;
  return scale;
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
    case PlanFormat::kWaypoints:
      return write_waypoints(arguments.output, instance, solution, scale(arguments, instance));
    case PlanFormat::kNavPath:
      return write_nav_paths(arguments.output, instance, solution, scale(arguments, instance));
    case PlanFormat::kPlanViz:
      return write_planviz(arguments.output, instance, solution);
  }
}

}  // namespace

void convert_plan(const ConvertArguments& arguments, InstanceFormat from, PlanFormat to) {
  const LoadedInstance loaded = load(arguments, from);
  print_warnings(loaded.warnings);
  AgentOrder order;
  const Solution solution = read_solution(arguments.plan, loaded.instance, &order);
  const auto violations = check_in_file(loaded.instance, solution, order, 1);
  if (!violations.empty())
    throw InputError(arguments.plan, violations.front().json_pointer, violations.front().message);
  require_distinct_files(arguments.output, loaded.map_path, "the map");
  write_representable(arguments, loaded.instance, from,
                      [&] { write_plan_as(arguments, loaded, solution, to); });
  fmt::print("wrote {}: {} paths, cost {}\n", arguments.output, loaded.instance.agent_count(),
             solution.plan->cost);
}

}  // namespace grove::detail
