// SPDX-License-Identifier: MIT
// grove convert: reads INSTANCE and locates, in that file, what cannot be converted.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <vector>

#include "io/format_support.h"
#include "io/input_error.h"
#include "io/libmrp_file.h"
#include "io/mapfw_file.h"
#include "io/scenario_file.h"
#include "tools/convert/convert_parts.h"

namespace grove::detail {
namespace {

LoadedInstance read_scen(const ConvertArguments& arguments) {
  if (arguments.map.empty()) throw CLI::ValidationError("--map", "required with a .scen INSTANCE");
  const auto rows =
      arguments.agents > 0
          ? static_cast<std::size_t>(arguments.agents)
          : std::min<std::size_t>(read_scenario(arguments.instance).size(), kRowCounts.max);
  return read_scenario_instance(arguments.instance, arguments.map, static_cast<int>(rows),
                                arguments.rules());
}

// Returns the place of the agent or task that `error` names, in a file of format `from`.
std::string place_of(const InstanceError& error, const Instance& instance, InstanceFormat from) {
  const std::string& field = error.field();
  const std::size_t slash = field.find('/');
  if (slash == std::string::npos) return "/" + field;
  const int index = std::stoi(field.substr(slash + 1));
  const bool is_task = field.starts_with("tasks");
  switch (from) {
    case InstanceFormat::kGrove:
      return "/" + field;
    case InstanceFormat::kLibmrp:
    case InstanceFormat::kPotentialGoals:
    case InstanceFormat::kMgcbs:
      if (field.ends_with("/goals")) return fmt::format("/agents/{}/potentialGoals", index);
      return is_task ? fmt::format("/agents/{}/goals", instance.task(index).agents.front())
                     : "/" + field;
    case InstanceFormat::kMapfw:
      return is_task ? fmt::format("/waypoints/{}", instance.task(index).agents.front())
                     : fmt::format("/starts/{}", index);
    case InstanceFormat::kScen:
      return fmt::format("line {}", index + 2);
  }
  return "/" + field;
}

std::string hint(Loss loss) {
  if (loss == Loss::kIds) return " (--drop ids leaves the ids out)";
  return loss == Loss::kTasks ? " (--drop tasks leaves the tasks out)" : "";
}

}  // namespace

bool ConvertArguments::drops(const std::string& what) const {
  return std::ranges::count(CLI::detail::split(drop, ','), what) > 0;
}

LoadedInstance load(const ConvertArguments& arguments, InstanceFormat from) {
  if (from == InstanceFormat::kGrove) return read_instance(arguments.instance, arguments.rules());
  if (from == InstanceFormat::kScen) return read_scen(arguments);
  std::vector<std::string> warnings;
  Instance instance = from == InstanceFormat::kMapfw
                          ? read_mapfw_problem(arguments.instance, &warnings)
                          : read_libmrp_instance(arguments.instance, &warnings, arguments.rules());
  return {std::move(instance), {}, std::move(warnings)};
}

void write_representable(const ConvertArguments& arguments, const Instance& instance,
                         InstanceFormat from, const std::function<void()>& write) {
  try {
    write();
  } catch (const NotRepresentable& error) {
    throw InputError(arguments.instance, place_of(error, instance, from),
                     error.what() + hint(error.loss()));
  } catch (const InstanceError& error) {
    throw InputError(arguments.instance, place_of(error, instance, from), error.what());
  }
}

}  // namespace grove::detail
