// SPDX-License-Identifier: MIT
#include "grove/detail/batch/outcome.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "grove/detail/io/input_error.h"
#include "grove/detail/model/check.h"

namespace grove::detail::batch {
namespace {

template <typename Map>
std::optional<typename Map::mapped_type> find(const Map& map, const char* name) {
  const auto it = map.find(name);
  return it == map.end() ? std::nullopt : std::optional(it->second);
}

// Those that have no column, without zeros.
std::string other_counts(const Stats& stats) {
  constexpr std::array<std::string_view, 7> kColumns{
      "roots_generated", "rtsp_calls", "nodes_expanded", "low_level_calls", "seed",
      "threads",         "ranks"};
  std::string text;
  for (const auto& [name, count] : stats.counts) {
    if (count == 0 || std::ranges::find(kColumns, name) != kColumns.end()) continue;
    text += fmt::format("{}{}={}", text.empty() ? "" : " ", name, count);
  }
  return text;
}

// What is wrong with the claim; empty: nothing.
std::string mistake(const Instance& instance, const Solution& solution) {
  if (!solution.plan) {
    if (solution.status == Status::kUnknown || solution.status == Status::kInfeasible) return "";
    return fmt::format("claims to be {} without a plan", to_string(solution.status));
  }
  const auto violations = check(instance, solution, 1);
  if (violations.empty()) return "";
  return fmt::format("the plan is wrong: {}: {}", violations[0].place,
                     one_line(violations[0].message));
}

}  // namespace

Outcome outcome_of(const Instance& instance, const Solution& solution) {
  const Stats& stats = solution.stats;
  Outcome outcome{.roots = find(stats.counts, "roots_generated"),
                  .rtsp_calls = find(stats.counts, "rtsp_calls"),
                  .nodes = find(stats.counts, "nodes_expanded"),
                  .low_level_calls = find(stats.counts, "low_level_calls"),
                  .peak_memory_mb = find(stats.measures, "peak_memory_mb"),
                  .counts = other_counts(stats),
                  .version = find(stats.texts, "version").value_or(""),
                  .error = mistake(instance, solution)};
  if (!outcome.error.empty()) return outcome;
  if (solution.plan) outcome.cost = solution.plan->cost;
  outcome.error = find(stats.texts, "stopped_by").value_or("");
  if (outcome.error == "interrupt") return outcome;
  outcome.status = to_string(solution.status);
  outcome.solved = solution.plan.has_value() && outcome.error.empty();
  if (solution.status != Status::kInfeasible) outcome.lower_bound = solution.lower_bound;
  return outcome;
}

}  // namespace grove::detail::batch
