// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/App.hpp>
#include <cstdint>

#include "tools/generate/instance_generator.h"

namespace grove::detail {

// The options --turning, --turn-steps, --goal-headings and --durations. The object must outlive the
// parsing of the command line.
class ExtrasArguments {
 public:
  void add_to(CLI::App& command);

  // Returns the extras. `with_goals`: whether some agents will have destinations. Throws
  // CLI::ValidationError if the arguments contradict each other.
  Extras extras(bool with_goals) const;

 private:
  bool turning_ = false;
  bool goal_headings_ = false;
  std::int64_t turn_steps_ = 1;
  Extras::Range durations_;
  const CLI::App* command_ = nullptr;
};

}  // namespace grove::detail
