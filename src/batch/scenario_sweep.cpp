// SPDX-License-Identifier: MIT
#include "batch/scenario_sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <string_view>
#include <system_error>

#include "batch/entry_collector.h"
#include "io/input_error.h"
#include "io/scenario_file.h"

namespace grove::detail::batch {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kScenario = ".scen";

struct Found {
  std::vector<fs::path> scenarios;            // in order of name
  std::multimap<std::string, fs::path> maps;  // by file name
  bool has_instances = false;
};

void sort_in(Found& found, const fs::path& path) {
  const std::string name = path.filename().string();
  if (name.ends_with(kScenario)) found.scenarios.push_back(path);
  if (name.ends_with(".map")) found.maps.emplace(name, path);
  found.has_instances |= name.ends_with(kInstanceSuffix);
}

Found scan_folder(const fs::path& place) {
  Found found;
  try {
    const bool is_folder = fs::is_directory(place);
    const fs::path folder = is_folder ? place : place.parent_path();
    if (is_folder) {
      for (const auto& item : fs::recursive_directory_iterator(folder))
        if (item.is_regular_file()) sort_in(found, item.path());
    } else {
      found.scenarios.push_back(place);
      for (const auto& item : fs::directory_iterator(folder.empty() ? "." : folder))
        if (item.path().extension() == ".map") sort_in(found, item.path());
    }
  } catch (const fs::filesystem_error& error) {
    throw InputError(place.string(), "", "cannot be read: " + error.code().message());
  }
  std::ranges::sort(found.scenarios);
  return found;
}

// Sort key that compares a trailing number by value: "random-32-32-20-random-2" comes before
// "random-32-32-20-random-10".
std::pair<std::string, long> natural(const fs::path& path) {
  const std::string stem = path.stem().string();
  const std::size_t digits = stem.find_last_not_of("0123456789") + 1;
  const std::string number = stem.substr(digits).substr(0, 9);
  return {stem.substr(0, digits), number.empty() ? 0 : std::stol(number)};
}

// The map in the scenario's folder or, if there is none, the only map of that name.
fs::path map_of(const fs::path& scenario, const Found& found,
                const std::vector<ScenarioRow>& rows) {
  const std::string name = fs::path(rows.front().map).filename().string();
  const auto [first, last] = found.maps.equal_range(name);
  for (auto it = first; it != last; ++it)
    if (it->second.parent_path() == scenario.parent_path()) return it->second;
  const auto count = std::distance(first, last);
  if (count == 1) return first->second;
  throw InputError(scenario.string(), fmt::format("line {}", rows.front().line),
                   fmt::format("{} map{} {} there; expected one beside the scenario, or exactly "
                               "one in the folder of the scenarios or below",
                               count == 0 ? "there is no" : fmt::format("there are {}", count),
                               count == 0 ? "" : "s", name));
}

}  // namespace

bool matches(std::string_view name, std::string_view pattern) {
  const std::size_t star = pattern.find('*');
  if (star == std::string_view::npos) return name == pattern;
  if (!name.starts_with(pattern.substr(0, star))) return false;
  const std::string_view rest = pattern.substr(star + 1);
  for (std::size_t begin = star; begin <= name.size(); ++begin)
    if (matches(name.substr(begin), rest)) return true;
  return false;
}

bool holds_scenarios(const fs::path& place) {
  if (place.string().ends_with(kScenario)) return true;
  std::error_code error;
  if (!fs::is_directory(place, error)) return false;
  const Found found = scan_folder(place);
  return !found.scenarios.empty() && !found.has_instances;
}

SweptScenarios read_scenarios(const fs::path& place, const ScenarioSweep& sweep,
                              const InputRules& rules) {
  Found found = scan_folder(place);
  std::erase_if(found.scenarios, [&](const fs::path& path) {
    return !matches(path.stem().string(), sweep.scenarios);
  });
  if (found.scenarios.empty())
    throw InputError(
        place.string(), "",
        fmt::format("has no scenario '{}.scen'; expected at least one", sweep.scenarios));
  std::ranges::stable_sort(found.scenarios, {}, natural);
  std::error_code error;
  EntryCollector collector(place, rules);
  SweptScenarios swept;
  for (const fs::path& scenario : found.scenarios) {
    const auto rows = read_scenario(scenario);
    if (rows.empty()) throw InputError(scenario.string(), "", "has no rows; expected at least one");
    const std::string map = map_of(scenario, found, rows).string();
    for (const int agents : sweep.agents) {
      if (agents > static_cast<int>(rows.size())) {
        ++swept.too_short;
        break;
      }
      Entry entry{.id = id_of(scenario,
                              fs::is_directory(place, error) ? place : place.parent_path(), agents),
                  .path = scenario.string(),
                  .map = map,
                  .agents = agents};
      collector.add(std::move(entry), scenario.filename().string());
    }
  }
  swept.entries = collector.take();
  if (swept.entries.empty())
    throw InputError(
        place.string(), "",
        fmt::format("no scenario has {} rows; expected fewer agents", sweep.agents.front()));
  return swept;
}

}  // namespace grove::detail::batch
