// SPDX-License-Identifier: MIT
// Command-line options for the position and scale of a grid in world coordinates.
#pragma once

#include <CLI/App.hpp>
#include <string>

#include "io/frame.h"
#include "model/instance.h"

namespace grove::detail {

// The options --cell-size and --origin. The object must outlive the parsing of the command line.
class FrameArguments {
 public:
  void add_to(CLI::App& command);

  bool given() const { return cell_size_ > 0 || has_origin(); }
  bool has_origin() const { return !origin_.empty(); }
  // Returns the side of a cell in metres; 0 if --cell-size is not given.
  double cell_size() const { return cell_size_; }
  // Returns the frame, with defaults for options that are not given. Throws CLI::ValidationError if
  // --origin is not two numbers, or if an option is given for an instance on a roadmap, because a
  // roadmap has its own coordinates in metres.
  Frame frame(const Instance& instance) const;

 private:
  double cell_size_ = 0;  // metres; 0: not given
  std::string origin_;
};

}  // namespace grove::detail
