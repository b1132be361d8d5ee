// SPDX-License-Identifier: MIT
// grove convert: converts a road network of another tool to a roadmap.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "io/graphml_file.h"
#include "io/input_error.h"
#include "io/lif_file.h"
#include "io/roadmap_file.h"
#include "tools/common/instance_arguments.h"
#include "tools/convert/convert_parts.h"

namespace grove::detail {
namespace {

// Returns the source format: --from if given, otherwise "graphml" or "lif" according to the suffix;
// "" if the suffix is unknown.
std::string roadmap_source_format(const ConvertArguments& arguments) {
  if (!arguments.from.empty()) return arguments.from;
  if (arguments.instance.ends_with(".graphml")) return "graphml";
  return arguments.instance.ends_with(".lif.json") ? "lif" : "";
}

bool is_roadmap_target(const ConvertArguments& arguments) {
  return arguments.to == "roadmap" ||
         (arguments.to.empty() && arguments.output.ends_with(".roadmap.json"));
}

std::string require_roadmap_source_format(const ConvertArguments& arguments) {
  const std::string format = roadmap_source_format(arguments);
  if (format == "graphml" || format == "lif") return format;
  if (!format.empty())
    throw CLI::ValidationError(
        "--from",
        fmt::format("found '{}'; expected graphml or lif, because OUT is a roadmap", format));
  throw CLI::ValidationError(
      "--from",
      fmt::format("required, because the suffix of '{}' is not that of a format; expected "
                  "graphml or lif, because OUT is a roadmap",
                  arguments.instance));
}

void require_roadmap_target(const ConvertArguments& arguments, const std::string& format) {
  if (is_roadmap_target(arguments)) return;
  throw CLI::ValidationError(
      "--to", fmt::format("found '{}'; {} contains roads; expected roadmap, or a file "
                          "*.roadmap.json",
                          arguments.to.empty() ? arguments.output : arguments.to, format));
}

std::optional<double> given(double value) {
  return value > 0 ? std::optional(value) : std::nullopt;
}

StepScale require_scale(const ConvertArguments& arguments) {
  if (arguments.metres_per_step == 0 && arguments.seconds_per_step == 0)
    throw CLI::ValidationError("--metres-per-step",
                               "required; expected metres per step, or --seconds-per-step");
  return {given(arguments.metres_per_step), given(arguments.seconds_per_step)};
}

RoadNetwork read_network(const ConvertArguments& arguments, const std::string& format) {
  std::vector<std::string> warnings;
  RoadNetwork network =
      format == "lif"
          ? read_lif(arguments.instance, {arguments.layout, arguments.vehicle_type}, &warnings)
          : read_graphml(arguments.instance, &warnings);
  print_warnings(warnings);
  return network;
}

// Throws InputError if there is no road, because robots could not move.
void require_roads(const SteppedRoads& stepped, const ConvertArguments& arguments) {
  if (!stepped.roads.empty()) return;
  throw InputError(
      arguments.instance, "",
      fmt::format("has no edge{}; expected at least one",
                  arguments.vehicle_type.empty() ? ""
                                                 : fmt::format(" that vehicle type '{}' may use",
                                                               one_line(arguments.vehicle_type))));
}

void warn_of_unused_times(const RoadNetwork& network, const StepScale& scale) {
  const auto count = std::ranges::count_if(
      network.links, [](const Link& link) { return link.seconds.has_value(); });
  if (count > 0 && !scale.seconds_per_step)
    print_warnings(
        {fmt::format("{}: has a speed or a duration for {} edges; expected "
                     "--seconds-per-step to use them",
                     one_line(network.file), count)});
}

// Warns about pairs of opposite one-way roads that may be a single two-way lane, because only the
// user knows whether they are.
void warn_of_opposite_roads(const std::vector<Road>& roads, const ConvertArguments& arguments) {
  const OppositeRoads count = opposite_roads(roads);
  std::vector<std::string> warnings;
  const int pairs = count.alike + count.unlike;
  if (!arguments.merges_lanes && pairs > 0)
    warnings.push_back(fmt::format(
        "{}: {} pairs of opposite edges are two lanes each, on which robots pass one another; "
        "use --merge-lanes if robots share one lane",
        one_line(arguments.instance), pairs));
  if (arguments.merges_lanes && count.unlike > 0)
    warnings.push_back(fmt::format(
        "{}: {} pairs of opposite edges take different numbers of steps and remain two lanes each",
        one_line(arguments.instance), count.unlike));
  if (!arguments.merges_lanes && count.single_step > 0)
    warnings.push_back(fmt::format(
        "{}: robots cannot pass one another on {} of these pairs, which take one step; use shorter "
        "steps to allow it",
        one_line(arguments.instance), count.single_step));
  print_warnings(warnings);
}

std::string in_units(const Rounding& rounding, const StepScale& scale) {
  return scale.seconds_per_step
             ? fmt::format("{:.4g} s", rounding.absolute() * *scale.seconds_per_step)
             : fmt::format("{:.4g} m", rounding.absolute() * *scale.metres_per_step);
}

std::string description(const Rounding& rounding, const RoadNetwork& network) {
  const Link& link = network.links[rounding.link];
  return fmt::format("{:.10g} became {}, {} from '{}' to '{}'", rounding.exact, rounding.steps,
                     link.place, one_line(network.vertices[link.from].id),
                     one_line(network.vertices[link.to].id));
}

void print_rounding(const SteppedRoads& stepped, const RoadNetwork& network,
                    const StepScale& scale) {
  const Rounding& absolute = stepped.max_absolute;
  const Rounding& relative = stepped.max_relative;
  if (absolute.link < 0) {
    fmt::print("rounding: none; every road takes a whole number of steps\n");
    return;
  }
  fmt::print("rounding: at most {:.4g} steps ({}): {}\n", absolute.absolute(),
             in_units(absolute, scale), description(absolute, network));
  fmt::print("rounding: at most {:.4g} %: {}\n", 100 * relative.relative(),
             description(relative, network));
}

void print_roadmap(const std::string& file, const Roadmap& roadmap) {
  const auto& roads = roadmap.roads();
  fmt::print("wrote {}: {} vertices, {} roads, {} of them one way, {} places\n", file,
             roadmap.vertices().size(), roads.size(),
             std::ranges::count(roads, true, &Road::one_way), roadmap.place_count());
}

}  // namespace

bool converts_roads(const ConvertArguments& arguments) {
  const std::string format = roadmap_source_format(arguments);
  return format == "graphml" || format == "lif" || is_roadmap_target(arguments);
}

void convert_roadmap(const ConvertArguments& arguments) {
  const std::string format = require_roadmap_source_format(arguments);
  require_roadmap_target(arguments, format);
  if (format != "lif" && (!arguments.layout.empty() || !arguments.vehicle_type.empty()))
    throw CLI::ValidationError(arguments.layout.empty() ? "--vehicle-type" : "--layout",
                               "allowed only with LIF");
  const StepScale scale = require_scale(arguments);
  const RoadNetwork network = read_network(arguments, format);
  const SteppedRoads stepped = in_steps(network, scale, arguments.rules());
  require_roads(stepped, arguments);
  warn_of_unused_times(network, scale);
  warn_of_opposite_roads(stepped.roads, arguments);
  const Roadmap roadmap(network.vertices,
                        arguments.merges_lanes ? with_merged_lanes(stepped.roads) : stepped.roads);
  write_roadmap(arguments.output, roadmap);
  print_roadmap(arguments.output, roadmap);
  print_rounding(stepped, network, scale);
}

}  // namespace grove::detail
