// SPDX-License-Identifier: MIT
// grove view, of two programs: grove itself, and grove-picture, which can draw.
#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "model/instance.h"
#include "model/plan.h"

namespace grove::detail {

// Pictures that are asked for; a file without a name is not.
struct PictureOrder {
  std::string svg;
  std::string png;
  std::string gif;
  std::vector<double> moments;  // of SVG and PNG, in steps; at least one
  std::int64_t width = 800;     // pixels of a moment
  double speed = 4;             // steps that a GIF plays in a second

  bool is_empty() const { return svg.empty() && png.empty() && gif.empty(); }
};

// One of the two is set.
struct PictureMaker {
  // Replaces this process before it has read or written any file; does not return.
  std::function<void()> hand_over;
  // Draws the plan; nullptr: the instance. Calls `write` with each file and its content.
  std::function<void(
      const PictureOrder& order, const Instance& instance, const Plan* plan,
      const std::function<void(const std::string& file, const std::string& bytes)>& write)>
      draw;
};

void add_view_command(CLI::App& app, const PictureMaker& maker);

}  // namespace grove::detail
