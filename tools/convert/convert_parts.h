// SPDX-License-Identifier: MIT
// What one asks of grove convert, and the four things that it does.
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

// Of the first rows of a scenario.
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

// Reads INSTANCE. Throws InputError; CLI::ValidationError when an option is missing.
LoadedInstance load(const ConvertArguments& arguments, InstanceFormat from);

// INSTANCE, or the plan of it, as OUT; prints what was written. Throw InputError, with the place in
// INSTANCE of what OUT cannot hold; CLI::ValidationError when options do not fit together.
void convert_instance(const ConvertArguments& arguments, InstanceFormat from, InstanceFormat to);
void convert_plan(const ConvertArguments& arguments, InstanceFormat from, PlanFormat to);

// Whether INSTANCE is a file of roads, or OUT a roadmap; and the one as the other. Throws as above.
bool is_about_roads(const ConvertArguments& arguments);
void convert_roadmap(const ConvertArguments& arguments);

// Whether OUT is a map, of another tool's map; and the one as the other. Throws as above.
bool is_about_maps(const ConvertArguments& arguments);
void convert_map(const ConvertArguments& arguments);

// Runs `write`; of what OUT cannot hold it says where it is in `instance`, which was read from a
// file of format `from`.
void express(const ConvertArguments& arguments, const Instance& instance, InstanceFormat from,
             const std::function<void()>& write);

}  // namespace grove::detail
