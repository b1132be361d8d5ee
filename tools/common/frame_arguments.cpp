// SPDX-License-Identifier: MIT
#include "tools/common/frame_arguments.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <string_view>

#include "io/input_error.h"
#include "model/parse_number.h"
#include "tools/common/options.h"

namespace grove::detail {
namespace {

constexpr double kMinCellSize = 1e-3;
constexpr double kMaxCellSize = 1e3;
constexpr double kFarthest = 1e7;

double parse_coordinate(const std::string& text, std::string_view number) {
  if (const auto value = parse_number(number, -kFarthest, kFarthest)) return *value;
  throw CLI::ValidationError(
      "--origin", fmt::format("found '{}'; expected X,Y, two numbers in metres, such as -10,-5.5",
                              one_line(text)));
}

Point parse_point(const std::string& text) {
  const std::size_t comma = text.find(',');
  const std::string y = comma == std::string::npos ? "" : text.substr(comma + 1);
  return {parse_coordinate(text, text.substr(0, comma)), parse_coordinate(text, y)};
}

}  // namespace

void FrameArguments::add_to(CLI::App& command) {
  add_number(command, "--cell-size", cell_size_, kMinCellSize, kMaxCellSize,
             "distance between neighbouring cells, metres; default: 1")
      ->default_str("")
      ->type_name("METRES");
  command
      .add_option("--origin", origin_,
                  "position of the lower left corner of the map, metres; default: 0,0")
      ->type_name("X,Y");
}

Frame FrameArguments::frame(const Instance& instance) const {
  if (given() && !instance.is_on_grid())
    throw CLI::ValidationError(cell_size_ > 0 ? "--cell-size" : "--origin",
                               "allowed only on a grid; found a roadmap, which has coordinates");
  Frame frame;
  if (cell_size_ > 0) frame.cell_size = cell_size_;
  if (!origin_.empty()) frame.origin = parse_point(origin_);
  return frame;
}

}  // namespace grove::detail
