// SPDX-License-Identifier: MIT
// Position and scale of a grid in world coordinates, from the command line.
#pragma once

#include <CLI/App.hpp>
#include <string>

#include "io/frame.h"
#include "model/instance.h"

namespace grove::detail {

// --cell-size and --origin. Must outlive the parsing of the command line.
class FrameArguments {
 public:
  void add_to(CLI::App& command);

  bool given() const { return cell_size_ > 0 || has_origin(); }
  bool has_origin() const { return !origin_.empty(); }
  // Metres; 0 if not given.
  double cell_size() const { return cell_size_; }
  // Throws CLI::ValidationError if --origin is not two numbers, or on a roadmap, which has
  // coordinates in metres.
  Frame frame(const Instance& instance) const;

 private:
  double cell_size_ = 0;  // metres; 0: not given
  std::string origin_;
};

}  // namespace grove::detail
