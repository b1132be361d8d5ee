// SPDX-License-Identifier: MIT
// How a grid lies in the world, as one types it.
#pragma once

#include <CLI/App.hpp>
#include <string>

#include "io/frame.h"
#include "model/instance.h"

namespace grove::detail {

// --cell-size and --origin. Must outlive the parsing.
class FrameArguments {
 public:
  void add_to(CLI::App& command);

  bool given() const { return cell_size_ > 0 || has_origin(); }
  bool has_origin() const { return !origin_.empty(); }
  // Metres; 0: not given.
  double cell_size() const { return cell_size_; }
  // Throws CLI::ValidationError: no two numbers; or on a roadmap, which is in metres as it is.
  Frame frame(const Instance& instance) const;

 private:
  double cell_size_ = 0;  // 0: not given
  std::string origin_;
};

}  // namespace grove::detail
