// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <iterator>

#include "io/atomic_file.h"
#include "io/format_support.h"
#include "io/plan_export.h"
#include "io/plan_steps.h"
#include "io/yaml_text.h"

namespace grove::detail {
namespace {

// The line "  key: value" if the run has a counter `name`; else "".
std::string count_line(const Stats& stats, const std::string& name, std::string_view key) {
  const auto it = stats.counts.find(name);
  return it == stats.counts.end() ? "" : fmt::format("  {}: {}\n", key, it->second);
}

std::string statistics_text(const Solution& solution) {
  const Stats& stats = solution.stats;
  std::string text = fmt::format("statistics:\n  cost: {}\n  makespan: {}\n", solution.plan->cost,
                                 makespan(*solution.plan));
  if (const auto it = stats.measures.find("wall_s"); it != stats.measures.end())
    text += fmt::format("  runtime: {}\n", it->second);
  return text + count_line(stats, "nodes_expanded", "highLevelExpanded") +
         count_line(stats, "low_level_expanded", "lowLevelExpanded");
}

void add_steps(std::string& text, const Grid& grid, const Path& path) {
  const auto steps = until_rest(path);
  for (std::size_t t = 0; t < steps.size(); ++t) {
    const Position p = grid.position(steps[t]);
    fmt::format_to(std::back_inserter(text), "    - x: {}\n      y: {}\n      t: {}\n", p.x, p.y,
                   t);
  }
}

// YAML parsers search for the colon only within this number of characters.
constexpr std::size_t kLongestKey = 1024;

std::string key_text(const Instance& instance, AgentIndex agent) {
  std::string key = yaml_text(instance.agent(agent).id);
  if (key.size() > kLongestKey)
    throw NotRepresentable(
        fmt::format("agents/{}", agent),
        fmt::format("the id has {} bytes in YAML, where it is a key; expected at most {}",
                    key.size(), kLongestKey),
        Loss::kNothing);
  return key;
}

}  // namespace

void write_libmrp_schedule(const std::filesystem::path& path, const Instance& instance,
                           const Solution& solution) {
  require_free_grid(instance, "libMultiRobotPlanning's schedule");
  std::string text = statistics_text(solution) + "schedule:\n";
  for (AgentIndex i = 0; i < instance.agent_count(); ++i) {
    text += fmt::format("  {}:\n", key_text(instance, i));
    add_steps(text, instance.grid(), solution.plan->agents[i].path);
  }
  write_file_atomically(path, text);
}

}  // namespace grove::detail
