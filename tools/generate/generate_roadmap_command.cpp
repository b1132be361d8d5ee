// SPDX-License-Identifier: MIT
// grove generate roadmap: planar and warehouse roadmaps.
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "io/roadmap_file.h"
#include "tools/generate/generate_commands.h"
#include "tools/generate/roadmap_generator.h"

namespace grove::detail {
namespace {

// Titles of the groups of options in the help, one group for each kind of roadmap.
constexpr const char* kOnlyPlanar = "With --kind planar";
constexpr const char* kOnlyWarehouse = "With --kind warehouse";

constexpr const char* kRoadmapFooter =
    R"(Every vertex is reachable from every other. A road takes its length / metres-per-step, rounded up
to whole steps.

planar: vertices v0, v1, ... at random positions, at least a step apart, joined by straight roads
that do not cross (the Gabriel graph). Roads that are the only connection between two parts stay
two-way, whatever --one-way is.

warehouse: one-way aisles of alternating direction, with slots a0s0, a0s1, ... for tasks. A cross
aisle has two lanes, one for each direction, which meet the aisles at c0e0, ... (eastbound) and
c0w0, ... (westbound). Parking bays p0, p1, ... are beside the outermost lanes, joined to them at
g0, g1, ...; a robot at rest there does not block other robots. The defaults make 400 slots and 114
bays.

Examples:
  grove generate roadmap --kind planar --vertices 200 --one-way 30 --seed 1 -o town.roadmap.json
  grove generate roadmap --kind warehouse --aisles 30 --slots 40 -o depot.roadmap.json
  grove generate instance --roadmap depot.roadmap.json --tasks-on a --agents 100 --tasks 300 \
        -o depot.cts.json)";

struct RoadmapArguments {
  std::string kind;
  double metres_per_step = 1;
  std::int64_t vertices = 100;
  double width = 50;
  double height = 50;
  std::int64_t one_way = 0;
  std::int64_t seed = 0;
  std::int64_t aisles = 20;
  std::int64_t slots = 20;
  std::int64_t cross_aisles = 3;
  std::int64_t bays = 3;
  double aisle_spacing = 4;
  double slot_spacing = 1;
  std::string output;
};

Roadmap draw_planar(const RoadmapArguments& arguments) {
  return planar_roadmap({.vertices = static_cast<int>(arguments.vertices),
                         .width = arguments.width,
                         .height = arguments.height,
                         .one_way = static_cast<int>(arguments.one_way),
                         .metres_per_step = arguments.metres_per_step,
                         .seed = static_cast<std::uint64_t>(arguments.seed)});
}

Roadmap draw_warehouse(const RoadmapArguments& arguments) {
  return warehouse_roadmap({.aisles = static_cast<int>(arguments.aisles),
                            .slots = static_cast<int>(arguments.slots),
                            .cross_aisles = static_cast<int>(arguments.cross_aisles),
                            .bays = static_cast<int>(arguments.bays),
                            .aisle_spacing = arguments.aisle_spacing,
                            .slot_spacing = arguments.slot_spacing,
                            .metres_per_step = arguments.metres_per_step});
}

void require_options_of_kind(const CLI::App& command, bool planar) {
  for (const CLI::Option* option : command.get_options())
    if (option->count() > 0 && option->get_group() == (planar ? kOnlyWarehouse : kOnlyPlanar))
      throw CLI::ValidationError(option->get_name(), fmt::format("allowed only with --kind {}",
                                                                 planar ? "warehouse" : "planar"));
}

void run(const CLI::App& command, const RoadmapArguments& arguments) {
  const bool planar = arguments.kind == "planar";
  require_options_of_kind(command, planar);
  try {
    const Roadmap roadmap = planar ? draw_planar(arguments) : draw_warehouse(arguments);
    write_roadmap(arguments.output, roadmap);
    fmt::print("wrote {}: {} vertices, {} roads, {} of them one way\n", arguments.output,
               roadmap.vertices().size(), roadmap.roads().size(),
               std::ranges::count(roadmap.roads(), true, &Road::one_way));
  } catch (const std::invalid_argument& error) {
    throw CLI::ValidationError("roadmap", error.what());
  }
}

void add_planar_options(CLI::App& command, RoadmapArguments& arguments) {
  constexpr double kMaxSide = 10'000;
  const auto add = [&](CLI::Option* option) { option->group(kOnlyPlanar); };
  add(add_integer(command, "--vertices", arguments.vertices, {2, 10'000}, "number of vertices"));
  add(add_number(command, "--width", arguments.width, 1, kMaxSide,
                 "extent from west to east, metres"));
  add(add_number(command, "--height", arguments.height, 1, kMaxSide,
                 "extent from south to north, metres"));
  add(add_integer(command, "--one-way", arguments.one_way, {0, 100},
                  "share of one-way roads, percent"));
  add(add_integer(command, "--seed", arguments.seed, kSeeds, "seed of all random choices"));
}

void add_warehouse_options(CLI::App& command, RoadmapArguments& arguments) {
  constexpr double kMinSpacing = 0.1;
  constexpr double kMaxSpacing = 1000;
  const auto add = [&](CLI::Option* option) { option->group(kOnlyWarehouse); };
  add(add_integer(command, "--aisles", arguments.aisles, {2, 1000}, "number of aisles, even"));
  add(add_integer(command, "--slots", arguments.slots, {1, 1000}, "number of slots per aisle"));
  add(add_integer(command, "--cross-aisles", arguments.cross_aisles, {2, 100},
                  "number of cross aisles, including those at the ends"));
  add(add_integer(command, "--bays", arguments.bays, {0, 100},
                  "number of parking bays between two aisles, at either end of the aisles"));
  add(add_number(command, "--aisle-spacing", arguments.aisle_spacing, kMinSpacing, kMaxSpacing,
                 "distance between aisles, metres"));
  add(add_number(command, "--slot-spacing", arguments.slot_spacing, kMinSpacing, kMaxSpacing,
                 "distance between slots, between lanes, and from a lane to a bay, metres"));
}

}  // namespace

void add_generate_roadmap_command(CLI::App& generate) {
  const auto arguments = std::make_shared<RoadmapArguments>();
  CLI::App* command =
      generate.add_subcommand("roadmap", "Generate a roadmap: planar or a warehouse");
  command->footer(kRoadmapFooter);
  command->add_option("--kind", arguments->kind, "kind: random points and roads, or a warehouse")
      ->required()
      ->type_name("planar|warehouse")
      ->check(one_of({"planar", "warehouse"}));
  add_number(*command, "--metres-per-step", arguments->metres_per_step, 0.01, 1000,
             "distance that a robot drives per step, metres");
  add_planar_options(*command, *arguments);
  add_warehouse_options(*command, *arguments);
  add_output(*command, arguments->output, "FILE.roadmap.json");
  command->callback([command, arguments] { run(*command, *arguments); });
}

}  // namespace grove::detail
