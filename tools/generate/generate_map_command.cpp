// SPDX-License-Identifier: MIT
// grove generate map: empty, random and rooms.
#include <fmt/format.h>

#include <memory>

#include "io/map_file.h"
#include "tools/generate/generate_commands.h"
#include "tools/generate/map_generator.h"

namespace grove::detail {
namespace {

constexpr IntegerRange kSides{1, 8192};

struct MapArguments {
  std::int64_t width = 32;
  std::int64_t height = 32;
  double obstacles = 0.2;
  std::int64_t room_size = 4;
  double doors = 1;
  std::int64_t seed = 0;
  std::string output;

  int columns() const { return static_cast<int>(width); }
  int rows() const { return static_cast<int>(height); }
  std::uint64_t map_seed() const { return static_cast<std::uint64_t>(seed); }
};

// The callbacks share the ownership of the arguments, which must outlive the parsing.
using SharedArguments = std::shared_ptr<MapArguments>;
using DrawMap = Grid (*)(const MapArguments&);

void run(const MapArguments& arguments, DrawMap draw) {
  try {
    const Grid grid = draw(arguments);
    write_map(arguments.output, grid);
    fmt::print("wrote {}: {} x {} cells, {} passable\n", arguments.output, grid.width(),
               grid.height(), grid.passable_count());
  } catch (const std::invalid_argument& error) {
    throw CLI::ValidationError("map", error.what());
  }
}

// Adds the command for one kind of map, with the options that all kinds have.
CLI::App* add_kind(CLI::App& map, const SharedArguments& arguments, const std::string& name,
                   const std::string& description, DrawMap draw) {
  CLI::App* command = map.add_subcommand(name, description);
  add_integer(*command, "--width", arguments->width, kSides, "columns");
  add_integer(*command, "--height", arguments->height, kSides, "rows");
  add_output(*command, arguments->output, "FILE.map");
  command->callback([arguments, draw] { run(*arguments, draw); });
  return command;
}

void add_empty(CLI::App& map, const SharedArguments& arguments) {
  add_kind(map, arguments, "empty", "No obstacles",
           [](const MapArguments& a) { return empty_map(a.columns(), a.rows()); });
}

void add_random(CLI::App& map, const SharedArguments& arguments) {
  CLI::App* command =
      add_kind(map, arguments, "random", "Random obstacles", [](const MapArguments& a) {
        return random_map(a.columns(), a.rows(), a.obstacles, a.map_seed());
      });
  add_number(*command, "--obstacles", arguments->obstacles, 0, 1,
             "share of the cells to block, from 0 to 1");
  add_integer(*command, "--seed", arguments->seed, kSeeds, "seed of all random choices");
}

void add_rooms(CLI::App& map, const SharedArguments& arguments) {
  CLI::App* command =
      add_kind(map, arguments, "rooms", "Square rooms with doors", [](const MapArguments& a) {
        return rooms_map(a.columns(), a.rows(), static_cast<int>(a.room_size), a.doors,
                         a.map_seed());
      });
  add_integer(*command, "--room-size", arguments->room_size, kSides, "side of a room, cells");
  add_number(*command, "--doors", arguments->doors, 0, 1,
             "share of the walls between two rooms that have a door, from 0 to 1");
  add_integer(*command, "--seed", arguments->seed, kSeeds, "seed of all random choices");
}

}  // namespace

void add_generate_map_command(CLI::App& generate) {
  CLI::App* map = generate.add_subcommand("map", "Generate a map: empty, random or rooms");
  map->footer(
      "All passable cells are connected: obstacles cut off no cell, and rooms have at least the\n"
      "doors that connect them. Doors and walls are one cell wide.\n"
      "\n"
      "Examples:\n"
      "  grove generate map random --width 32 --height 32 --obstacles 0.2 --seed 1 -o my.map\n"
      "  grove generate map rooms --room-size 7 --doors 0.9 --seed 1 -o rooms.map");
  map->require_subcommand(1);
  const auto arguments = std::make_shared<MapArguments>();
  add_empty(*map, arguments);
  add_random(*map, arguments);
  add_rooms(*map, arguments);
}

}  // namespace grove::detail
