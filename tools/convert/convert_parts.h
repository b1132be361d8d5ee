// SPDX-License-Identifier: MIT
// Arguments of grove convert, and its four conversions.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "io/instance_file.h"
#include "tools/common/file_formats.h"
#include "tools/common/frame_arguments.h"
#include "tools/common/instance_arguments.h"
#include "tools/common/machine.h"
#include "tools/common/options.h"

namespace grove::detail {

// Range of --agents.
inline constexpr IntegerRange kRowCounts{1, 1'000'000};

struct ConvertArguments {
  std::string instance;
  std::string output;
  std::string plan;
  std::string from;
  std::string to;
  std::string map;
  std::string scenario;
  std::int64_t agents = 0;
  std::string drop;
  bool flip_up_down = false;
  double metres_per_step = 0;  // 0: not given
  double seconds_per_step = 0;
  std::string layout;
  std::string vehicle_type;
  bool merges_lanes = false;
  FrameArguments frame;
  double robot_radius = 0;  // metres
  bool confined = false;

  InputRules rules() const { return input_rules(confined, default_memory_gb()); }
  bool drops(const std::string& what) const;
};

// Reads INSTANCE. Throws InputError, and CLI::ValidationError if an option is missing.
LoadedInstance load(const ConvertArguments& arguments, InstanceFormat from);

// Converts INSTANCE, or a plan of it, to OUT and prints a summary. Throw InputError, with the place
// in INSTANCE of a part that the format of OUT cannot express, and CLI::ValidationError if options
// contradict each other.
void convert_instance(const ConvertArguments& arguments, InstanceFormat from, InstanceFormat to);
void convert_plan(const ConvertArguments& arguments, InstanceFormat from, PlanFormat to);

// Whether INSTANCE is a file of roads or OUT a roadmap; and the conversion. Throws as above.
bool converts_roads(const ConvertArguments& arguments);
void convert_roadmap(const ConvertArguments& arguments);

// Whether INSTANCE is a map of another tool or OUT a map; and the conversion. Throws as above.
bool converts_maps(const ConvertArguments& arguments);
void convert_map(const ConvertArguments& arguments);

// Calls `write`. If the format of OUT cannot express a part of `instance`, throws InputError with
// the place of that part in the file, which has format `from`.
void express(const ConvertArguments& arguments, const Instance& instance, InstanceFormat from,
             const std::function<void()>& write);

}  // namespace grove::detail
