// SPDX-License-Identifier: MIT
#include "tools/common/file_formats.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <filesystem>
#include <span>
#include <string_view>

namespace grove::detail {
namespace {

template <typename Format>
struct Entry {
  std::string_view name;  // a value of --from or --to, or a suffix of file names
  Format format;
};
template <typename Format>
Entry(const char*, Format) -> Entry<Format>;  // clang 14 does not deduce it

constexpr std::array kInstanceNames = {
    Entry{"grove", InstanceFormat::kGrove},
    Entry{"libmrp", InstanceFormat::kLibmrp},
    Entry{"potential-goals", InstanceFormat::kPotentialGoals},
    Entry{"mgcbs", InstanceFormat::kMgcbs},
    Entry{"mapfw", InstanceFormat::kMapfw},
    Entry{"scen", InstanceFormat::kScen},
};
// Longer suffixes come first. The suffix .json implies no format, because Grove, MAPFW and many
// other tools use it.
constexpr std::array kInstanceSuffixes = {
    Entry{".mapfw.json", InstanceFormat::kMapfw}, Entry{".cts.json", InstanceFormat::kGrove},
    Entry{".yaml", InstanceFormat::kLibmrp},      Entry{".yml", InstanceFormat::kLibmrp},
    Entry{".scen", InstanceFormat::kScen},
};
constexpr std::array kPlanNames = {
    Entry{"libmrp", PlanFormat::kLibmrp},
    Entry{"mapf-visualizer", PlanFormat::kVisualizer},
    Entry{"eecbs", PlanFormat::kEecbs},
    Entry{"tracker", PlanFormat::kTracker},
    Entry{"tracker-csv", PlanFormat::kTrackerCsv},
    Entry{"waypoints", PlanFormat::kWaypoints},
    Entry{"nav-path", PlanFormat::kNavPath},
    Entry{"planviz", PlanFormat::kPlanViz},
};
constexpr std::array kPlanSuffixes = {
    Entry{".yaml", PlanFormat::kLibmrp},
    Entry{".yml", PlanFormat::kLibmrp},
    Entry{".csv", PlanFormat::kTrackerCsv},
};

template <typename Format>
std::string listed(std::span<const Entry<Format>> entries) {
  std::string text;
  for (const auto& entry : entries)
    text += fmt::format("{}{}", text.empty() ? "" : ", ", entry.name);
  return text;
}

template <typename Format>
Format find_format(const std::string& option, const std::string& name, const std::string& file,
                   std::span<const Entry<Format>> names, std::span<const Entry<Format>> suffixes) {
  for (const auto& entry : names)
    if (entry.name == name) return entry.format;
  if (!name.empty())
    throw CLI::ValidationError(option,
                               fmt::format("found '{}'; expected one of {}", name, listed(names)));
  for (const auto& entry : suffixes)
    if (file.ends_with(entry.name)) return entry.format;
  throw CLI::ValidationError(
      option,
      fmt::format(
          "required, because the suffix of '{}' is not that of a format; expected one of {}", file,
          listed(names)));
}

}  // namespace

InstanceFormat instance_format(const std::string& option, const std::string& name,
                               const std::string& file) {
  if (name.empty() && file.ends_with(".plan.json"))
    throw CLI::ValidationError(
        option, fmt::format("'{}' has the suffix of a plan; expected an instance, or "
                            "--plan PLAN INSTANCE OUT to convert a plan",
                            file));
  if (std::ranges::count(kPlanNames, name, &Entry<PlanFormat>::name) > 0 &&
      std::ranges::count(kInstanceNames, name, &Entry<InstanceFormat>::name) == 0)
    throw CLI::ValidationError(option,
                               fmt::format("{} is a format of plans; requires --plan PLAN", name));
  return find_format<InstanceFormat>(option, name, file, kInstanceNames, kInstanceSuffixes);
}

PlanFormat plan_format(const std::string& option, const std::string& name,
                       const std::string& file) {
  return find_format<PlanFormat>(option, name, file, kPlanNames, kPlanSuffixes);
}

bool has_separate_map(InstanceFormat format) {
  return format == InstanceFormat::kGrove || format == InstanceFormat::kScen;
}

bool holds_tasks(InstanceFormat format) {
  return format != InstanceFormat::kLibmrp && format != InstanceFormat::kPotentialGoals &&
         format != InstanceFormat::kScen;
}

bool has_suffix_of_other_format(const std::string& file) {
  return std::ranges::any_of(kInstanceSuffixes, [&](const Entry<InstanceFormat>& entry) {
    return !has_separate_map(entry.format) && file.ends_with(entry.name);
  });
}

std::string without_suffix(const std::string& file) {
  for (const auto& entry : kInstanceSuffixes)
    if (file.ends_with(entry.name)) return file.substr(0, file.size() - entry.name.size());
  return std::filesystem::path(file).replace_extension().string();
}

}  // namespace grove::detail
