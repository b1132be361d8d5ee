// SPDX-License-Identifier: MIT
// grove convert: converts maps of other tools to Moving AI maps.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <stdexcept>
#include <string_view>

#include "io/atomic_file.h"
#include "io/input_error.h"
#include "io/map_file.h"
#include "io/text_file.h"
#include "tools/convert/convert_parts.h"
#include "tools/convert/occupancy_map.h"

namespace grove::detail {
namespace {

constexpr std::string_view kFree = ". _0GSE";
constexpr std::string_view kWalls = "#@TOWXx1*";

// Returns the source format: --from if given, otherwise "ros" or "ascii" according to the suffix;
// "" if the suffix is unknown.
std::string map_source_format(const ConvertArguments& arguments) {
  if (!arguments.from.empty()) return arguments.from;
  if (arguments.instance.ends_with(".yaml") || arguments.instance.ends_with(".yml")) return "ros";
  return arguments.instance.ends_with(".txt") ? "ascii" : "";
}

Grid read_ascii(const std::string& file) {
  const std::string text = read_text(file);
  std::vector<std::string_view> lines = split_lines(text);
  while (!lines.empty() && lines.back().empty()) lines.pop_back();
  if (lines.empty() || lines.front().empty())
    throw InputError(file, line_and_column(1, 1), "the file is empty; expected rows of a map");
  std::vector<bool> passable;
  for (std::size_t y = 0; y < lines.size(); ++y) {
    if (lines[y].size() != lines.front().size())
      throw InputError(file, line_and_column(y + 1, 1),
                       fmt::format("found {} cells; expected {}, as in the first row",
                                   lines[y].size(), lines.front().size()));
    for (std::size_t x = 0; x < lines[y].size(); ++x) {
      const char c = lines[y][x];
      if (kFree.find(c) == std::string_view::npos && kWalls.find(c) == std::string_view::npos)
        throw InputError(file, line_and_column(y + 1, x + 1),
                         fmt::format("found '{}'; expected one of '{}' for a free cell, of '{}' "
                                     "for a wall",
                                     one_line(lines[y].substr(x, 1)), kFree, kWalls));
      passable.push_back(kFree.find(c) != std::string_view::npos);
    }
  }
  return Grid(static_cast<int>(lines.front().size()), static_cast<int>(lines.size()), passable);
}

// Returns `grid`. Throws InputError if it has no free cell; a map with a single free cell is valid.
Grid with_free_cells(const std::string& file, Grid grid) {
  if (grid.passable_count() == 0)
    throw InputError(file, "",
                     fmt::format("has no free cell; expected at least one of '{}'", kFree));
  return grid;
}

void print_map(const std::string& file, const Grid& grid) {
  fmt::print("wrote {}: {} x {} cells, {} passable\n", file, grid.width(), grid.height(),
             grid.passable_count());
}

CellMap read_occupancy(const OccupancyMap& map, const ConvertArguments& arguments) {
  try {
    return cells_of(map, arguments.frame.cell_size(), arguments.robot_radius);
  } catch (const std::invalid_argument& error) {
    throw CLI::ValidationError("--cell-size", error.what());
  }
}

bool has_moves(const Grid& grid) {
  for (Cell cell = 0; cell < grid.cell_count(); ++cell)
    if (!grid.moves(cell).empty()) return true;
  return false;
}

// Throws InputError, which names the option to change, if a robot cannot move on the map.
void require_moves(const CellMap& cells, const ConvertArguments& arguments) {
  if (has_moves(cells.grid)) return;
  const int left = cells.grid.passable_count();
  if (cells.too_near == 0 && cells.narrow == 0 && left == 0)
    throw InputError(arguments.instance, "",
                     "the middle of no cell is free; expected a map with free space, or a smaller "
                     "--cell-size");
  throw InputError(
      arguments.instance, "",
      fmt::format("{} on the map of cells of {:.4g} m for robots of radius {:.4g} m; expected a "
                  "smaller --robot-radius or --cell-size",
                  left == 0 ? "no cell is free" : "no two neighbouring cells are free",
                  arguments.frame.cell_size(), arguments.robot_radius));
}

void convert_occupancy(const ConvertArguments& arguments) {
  const double size = arguments.frame.cell_size();
  if (size == 0)
    throw CLI::ValidationError("--cell-size", "required; expected the size of a cell in metres");
  if (arguments.frame.has_origin())
    throw CLI::ValidationError("--origin", "not allowed with a map of ROS, which has an origin");
  const OccupancyMap map(arguments.instance, arguments.rules());
  const CellMap cells = read_occupancy(map, arguments);
  require_moves(cells, arguments);
  write_map(arguments.output, cells.grid);
  print_map(arguments.output, cells.grid);
  fmt::print(
      "free but blocked: {} cells whose middle is less than {:.4g} m from a wall, {} without "
      "a straight free path to a neighbour\n",
      cells.too_near, arguments.robot_radius, cells.narrow);
  fmt::print("position: --cell-size {:.10g} --origin {:.10g},{:.10g}\n", size, map.origin().x,
             map.origin().y);
}

}  // namespace

bool converts_maps(const ConvertArguments& arguments) {
  return arguments.to == "map" || (arguments.to.empty() && arguments.output.ends_with(".map")) ||
         arguments.from == "ros" || arguments.from == "ascii";
}

void convert_map(const ConvertArguments& arguments) {
  if (arguments.to != "map" && !(arguments.to.empty() && arguments.output.ends_with(".map")))
    throw CLI::ValidationError(
        "--to",
        fmt::format("found '{}'; {} contains a map; expected map, or a "
                    "file *.map",
                    arguments.to.empty() ? arguments.output : arguments.to, arguments.from));
  const std::string format = map_source_format(arguments);
  if (format == "ros") return convert_occupancy(arguments);
  if (arguments.frame.given() || arguments.robot_radius > 0)
    throw CLI::ValidationError("--cell-size, --robot-radius", "allowed only with a map of ROS");
  if (format != "ascii")
    throw CLI::ValidationError(
        "--from",
        fmt::format(
            "{}; expected ros or ascii, because OUT is a map",
            format.empty()
                ? fmt::format("required, because the suffix of '{}' is not that of a format",
                              arguments.instance)
                : fmt::format("found '{}'", format)));
  const Grid grid = with_free_cells(arguments.instance, read_ascii(arguments.instance));
  write_map(arguments.output, grid);
  print_map(arguments.output, grid);
}

}  // namespace grove::detail
