// SPDX-License-Identifier: MIT
// grove convert: converts an instance to a different format.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "io/atomic_file.h"
#include "io/format_support.h"
#include "io/input_error.h"
#include "io/libmrp_file.h"
#include "io/map_file.h"
#include "io/mapfw_file.h"
#include "io/scenario_file.h"
#include "tools/common/commands.h"
#include "tools/common/instance_arguments.h"
#include "tools/convert/convert_parts.h"
#include "tools/generate/generate_commands.h"

namespace grove::detail {
namespace {

namespace fs = std::filesystem;

bool same_map(const Grid& a, const Grid& b) {
  if (a.width() != b.width() || a.height() != b.height()) return false;
  for (Cell cell = 0; cell < a.cell_count(); ++cell)
    if (a.passable(cell) != b.passable(cell)) return false;
  return true;
}

void require_map_of_instance(const std::string& map, const ConvertArguments& arguments,
                             const Instance& instance) {
  if (!instance.is_on_grid())
    throw InputError(
        map, "",
        fmt::format("is a map; expected none, because '{}' is on a roadmap", arguments.instance));
  if (!same_map(read_map(map), instance.grid()))
    throw InputError(
        map, "",
        fmt::format("is not the map of '{}'; expected the same {} x {} "
                    "cells",
                    arguments.instance, instance.grid().width(), instance.grid().height()));
}

// The map file that OUT names.
struct OutputMap {
  std::string path;
  bool is_new = false;
};

OutputMap choose_map(const ConvertArguments& arguments, const LoadedInstance& loaded) {
  if (!arguments.map.empty()) {
    require_map_of_instance(arguments.map, arguments, loaded.instance);
    return {arguments.map};
  }
  if (!loaded.map_path.empty()) return {loaded.map_path.string()};
  const OutputMap beside{without_suffix(arguments.output) + ".map", true};
  std::error_code ignored;
  if (!fs::exists(fs::symlink_status(beside.path, ignored))) return beside;
  require_map_of_instance(beside.path, arguments, loaded.instance);  // never replace another map
  return {beside.path};
}

Instance reduced(const Instance& instance, const ConvertArguments& arguments, InstanceFormat to) {
  const bool drops_tasks = arguments.drops("tasks") && !holds_tasks(to);
  const bool has_agent_ids = to != InstanceFormat::kMapfw && to != InstanceFormat::kScen;
  const bool has_task_ids = to == InstanceFormat::kGrove;
  Instance result = drops_tasks ? without_tasks(instance) : instance;
  if (!arguments.drops("ids")) return result;
  if (!has_task_ids) result = with_default_task_ids(result);
  return has_agent_ids ? result : with_default_agent_ids(result);
}

void write_naming_map(const ConvertArguments& arguments, const LoadedInstance& loaded,
                      const Instance& instance, InstanceFormat to) {
  const OutputMap map = choose_map(arguments, loaded);
  require_distinct_files(arguments.output, map.path, "the map");
  require_writable(arguments.output);
  if (map.is_new) write_map(map.path, instance.grid());
  try {
    if (to == InstanceFormat::kScen)
      write_scenario_instance(arguments.output, instance, fs::path(map.path).filename().string());
    else
      write_instance(arguments.output, instance, map_as_seen_from(arguments.output, map.path));
  } catch (...) {
    std::error_code ignored;
    if (map.is_new) fs::remove(map.path, ignored);
    throw;
  }
  if (map.is_new)
    fmt::print("wrote {}: {} x {} cells\n", map.path, instance.grid().width(),
               instance.grid().height());
}

void write_as(const ConvertArguments& arguments, const LoadedInstance& loaded,
              const Instance& instance, InstanceFormat to) {
  switch (to) {
    case InstanceFormat::kGrove:
    case InstanceFormat::kScen:
      return write_naming_map(arguments, loaded, instance, to);
    case InstanceFormat::kLibmrp:
      return write_libmrp_instance(arguments.output, instance);
    case InstanceFormat::kPotentialGoals:
      return write_potential_goals(arguments.output, instance);
    case InstanceFormat::kMgcbs:
      return write_mgcbs_instance(arguments.output, instance);
    case InstanceFormat::kMapfw:
      return write_mapfw_problem(arguments.output, instance);
  }
}

}  // namespace

void convert_instance(const ConvertArguments& arguments, InstanceFormat from, InstanceFormat to) {
  const LoadedInstance loaded = load(arguments, from);
  print_warnings(loaded.warnings);
  require_distinct_files(arguments.output, loaded.map_path, "the map");
  write_representable(arguments, loaded.instance, from,
                      [&] { write_converted(arguments, loaded, loaded.instance, to); });
}

void write_converted(const ConvertArguments& arguments, const LoadedInstance& loaded,
                     const Instance& instance, InstanceFormat to) {
  const Instance result = reduced(instance, arguments, to);
  write_as(arguments, loaded, result, to);
  fmt::print("wrote {}: {} agents, {} tasks\n", arguments.output, result.agent_count(),
             result.task_count());
}

}  // namespace grove::detail
