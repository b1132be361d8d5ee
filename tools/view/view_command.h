// SPDX-License-Identifier: MIT
// The view command of two programs: grove, and grove-picture, which draws the pictures.
#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "model/instance.h"
#include "model/plan.h"

namespace grove::detail {

// Requested pictures; a picture without a file name is not requested.
struct PictureRequest {
  std::string svg;
  std::string png;
  std::string gif;
  std::vector<double> moments;  // times of SVG and PNG, in steps; at least one for draw()
  std::int64_t width = 800;     // of a moment or of the GIF, in pixels
  double speed = 4;             // of the GIF, in steps per second

  bool is_empty() const { return svg.empty() && png.empty() && gif.empty(); }
};

// How a program makes pictures. Exactly one of the two members is set.
struct PictureMaker {
  // Replaces this process (exec) before it has read or written any file; does not return.
  std::function<void()> exec_picture_program;
  // Draws the plan or, if it is nullptr, the instance. Calls `write` with each file and its
  // content.
  std::function<void(
      const PictureRequest& order, const Instance& instance, const Plan* plan,
      const std::function<void(const std::string& file, const std::string& bytes)>& write)>
      draw;
};

void add_view_command(CLI::App& app, const PictureMaker& maker);

}  // namespace grove::detail
