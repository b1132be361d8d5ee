// SPDX-License-Identifier: MIT
// Arguments of grove convert, and its four conversions: instance, plan, roadmap, map.
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
  std::string fix_choices;  // plan whose choices are fixed
  std::string from;
  std::string to;
  std::string map;
  std::string scenario;
  std::int64_t agents = 0;
  std::string drop;
  bool flip_up_down = false;
  double metres_per_step = 0;   // 0: not given
  double seconds_per_step = 0;  // 0: not given
  std::string layout;
  std::string vehicle_type;
  bool merges_lanes = false;
  FrameArguments frame;
  double robot_radius = 0;  // metres
  bool confined = false;

  InputRules rules() const { return input_rules(confined, default_memory_gb()); }
  bool drops(const std::string& what) const;
};

// Reads INSTANCE, which has format `from`. Throws InputError for bad files, and
// CLI::ValidationError if an option that this format requires is missing.
LoadedInstance load(const ConvertArguments& arguments, InstanceFormat from);

// Convert INSTANCE, or a plan for it, to OUT and print a summary. Throw InputError for bad files
// and if the format of OUT cannot express a part of INSTANCE (the error states its place in the
// file), and CLI::ValidationError if options contradict each other.
void convert_instance(const ConvertArguments& arguments, InstanceFormat from, InstanceFormat to);
void convert_plan(const ConvertArguments& arguments, InstanceFormat from, PlanFormat to);
// Fixes the choices of INSTANCE as the plan --fix-choices makes them. Writes the instance without
// choices to OUT, and its plan beside it.
void convert_choices(const ConvertArguments& arguments, InstanceFormat from, InstanceFormat to);

// Writes `instance` to OUT, which has format `to`, and prints a summary. If OUT needs a map file
// and there is none, writes `loaded`'s map beside OUT.
void write_converted(const ConvertArguments& arguments, const LoadedInstance& loaded,
                     const Instance& instance, InstanceFormat to);

// Returns whether INSTANCE is a road network of another tool or OUT is a roadmap, according to
// --from, --to and the suffixes.
bool converts_roads(const ConvertArguments& arguments);
// Converts a road network of another tool to a roadmap and prints a summary. Throws InputError and
// CLI::ValidationError.
void convert_roadmap(const ConvertArguments& arguments);

// Returns whether INSTANCE is a map of another tool according to --from, or OUT is a map according
// to --to or its suffix.
bool converts_maps(const ConvertArguments& arguments);
// Converts a map of another tool to a Moving AI map and prints a summary. Throws InputError and
// CLI::ValidationError.
void convert_map(const ConvertArguments& arguments);

// Calls `write`, which writes OUT. If it throws because the format of OUT cannot express a part of
// `instance`, throws InputError with the place of that part in INSTANCE, which has format `from`.
void write_representable(const ConvertArguments& arguments, const Instance& instance,
                         InstanceFormat from, const std::function<void()>& write);

}  // namespace grove::detail
