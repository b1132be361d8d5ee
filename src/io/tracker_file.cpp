// SPDX-License-Identifier: MIT
#include "io/tracker_file.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

#include "io/atomic_file.h"
#include "io/format_support.h"
#include "io/plan_steps.h"
#include "model/parse_number.h"

namespace grove::detail {
namespace {

using OrderedJson = nlohmann::ordered_json;

// Returns the letter of a step to a neighbouring cell, or of a wait.
char motion(Position from, Position to, TrackerUp up) {
  if (to.x != from.x) return to.x > from.x ? 'r' : 'l';
  if (to.y == from.y) return 'w';
  const bool is_up = (to.y < from.y) == (up == TrackerUp::kTowardsRowZero);
  return is_up ? 'u' : 'd';
}

// Returns the run-length encoding, such as "5r2d" for "rrrrrdd". A run of length one has no number.
std::string run_lengths(std::string_view motions) {
  std::string text;
  while (!motions.empty()) {
    const std::size_t run = std::min(motions.find_first_not_of(motions.front()), motions.size());
    if (run > 1) text += std::to_string(run);
    text += motions.front();
    motions.remove_prefix(run);
  }
  return text;
}

std::string motion_string(const Grid& grid, const Path& path, TrackerUp up) {
  const auto steps = until_rest(path);
  std::string motions;
  for (std::size_t t = 1; t < steps.size(); ++t)
    motions += motion(grid.position(steps[t - 1]), grid.position(steps[t]), up);
  return run_lengths(motions);
}

// Returns `text` as a CSV field, always quoted.
std::string csv_field(std::string_view text) {
  std::string field = "\"";
  for (char c : text) field += c == '"' ? std::string("\"\"") : std::string(1, c);
  return field + '"';
}

std::string json_text(const OrderedJson& row) {
  return "[" + row.dump(-1, ' ', false, OrderedJson::error_handler_t::replace) + "]\n";
}

std::string csv_text(const OrderedJson& row) {
  std::string head;
  std::string line;
  for (const auto& [key, value] : row.items()) {
    const std::string_view comma = head.empty() ? "" : ",";
    head += fmt::format("{}{}", comma, key);
    if (value.is_boolean())
      line += fmt::format("{}{}", comma, value.get<bool>() ? "TRUE" : "FALSE");
    else if (value.is_string())
      line += fmt::format("{}{}", comma, csv_field(value.get<std::string>()));
    else
      line += fmt::format("{}{}", comma, value.dump());
  }
  return head + "\n" + line + "\n";
}

}  // namespace

std::optional<TrackerScenario> parse_tracker_scenario(const std::string& map,
                                                      const std::string& type_and_number) {
  for (const std::string_view type : {"even", "random"}) {
    const std::string head = fmt::format("{}-", type);
    if (!type_and_number.starts_with(head)) continue;
    const auto number = parse_number(std::string_view(type_and_number).substr(head.size()), 0);
    if (number) return TrackerScenario{map, std::string(type), *number};
  }
  return std::nullopt;
}

void require_tracker_instance(const Instance& instance) {
  constexpr std::string_view kFormat = "a row of MAPF Tracker";
  require_free_grid(instance, kFormat);
  require_goals(instance, kFormat);
  if (instance.task_count() > 0)
    throw NotRepresentable("tasks/0",
                           fmt::format("task '{}' cannot be represented in {}, and bound and cost "
                                       "would be wrong without it; expected no tasks",
                                       instance.task(0).id, kFormat),
                           Loss::kNothing);
}

void write_tracker_row(const std::filesystem::path& path, const Instance& instance,
                       const Solution& solution, const TrackerScenario& scenario,
                       TrackerLayout layout, TrackerUp up) {
  require_tracker_instance(instance);
  std::string motions;
  std::string_view separator;
  for (const AgentPlan& agent : solution.plan->agents) {
    motions += separator;
    motions += motion_string(instance.grid(), agent.path, up);
    separator = "\n";
  }
  const OrderedJson row{{"map_name", scenario.map},
                        {"scen_type", scenario.type},
                        {"type_id", scenario.number},
                        {"agents", instance.agent_count()},
                        {"lower_cost", solution.lower_bound},
                        {"solution_cost", solution.plan->cost},
                        {"flip_up_down", up == TrackerUp::kAwayFromRowZero},
                        {"solution_plan", motions}};
  write_file_atomically(path, layout == TrackerLayout::kJson ? json_text(row) : csv_text(row));
}

}  // namespace grove::detail
