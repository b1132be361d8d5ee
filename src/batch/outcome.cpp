// SPDX-License-Identifier: MIT
#include "batch/outcome.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "io/input_error.h"
#include "model/assert.h"
#include "model/check.h"
#include "model/parse_number.h"

namespace grove::detail::batch {
namespace {

template <typename Map>
std::optional<typename Map::mapped_type> find(const Map& map, const char* name) {
  const auto it = map.find(name);
  return it == map.end() ? std::nullopt : std::optional(it->second);
}

// The counters that are not 0 and have no column in the result table.
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

// Describes what is wrong with the solution; empty if nothing is.
std::string mistake(const Instance& instance, const Solution& solution) {
  if (!solution.plan) {
    if (solution.status == Status::kUnknown || solution.status == Status::kInfeasible) return "";
    return fmt::format("claims to be {} without a plan", to_string(solution.status));
  }
  const auto violations = check(instance, solution, 1);
  if (violations.empty()) return "";
  return fmt::format("the plan is wrong: {}: {}", violations[0].json_pointer,
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
  GROVE_CHECK(!outcome.cost || !outcome.lower_bound || *outcome.lower_bound <= *outcome.cost,
              "the lower bound of a checked plan is at most its cost");
  return outcome;
}

void thin_out(std::vector<TracePoint>& trace, std::size_t max_count) {
  while (trace.size() > std::max<std::size_t>(max_count, 2)) {
    std::vector<TracePoint> kept;
    for (std::size_t i = 0; i < trace.size(); ++i)
      if (i % 2 == 0 || i + 1 == trace.size()) kept.push_back(trace[i]);
    GROVE_CHECK(
        kept.front() == trace.front() && kept.back() == trace.back() && kept.size() < trace.size(),
        "a thinner trace keeps the first and the last point");
    trace = std::move(kept);
  }
}

std::string trace_text(const std::vector<TracePoint>& trace) {
  std::string text;
  for (const TracePoint& point : trace)
    text +=
        fmt::format("{}{}:{}:{}", text.empty() ? "" : " ", std::round(point.seconds * 1e6) / 1e6,
                    point.cost, point.lower_bound ? std::to_string(*point.lower_bound) : "-");
  return text;
}

std::vector<TracePoint> parse_trace(const std::string& text) {
  std::vector<TracePoint> trace;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const std::size_t first = word.find(':');
    const std::size_t second = word.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos)
      throw std::invalid_argument(fmt::format("trace '{}'", one_line(word)));
    const auto seconds = parse_number<double>(word.substr(0, first), 0);
    const auto cost = parse_number<Cost>(word.substr(first + 1, second - first - 1), 0);
    const std::string bound = word.substr(second + 1);
    const auto lower_bound = bound == "-" ? std::nullopt : parse_number<Cost>(bound, 0);
    if (!seconds || !cost || (!lower_bound && bound != "-"))
      throw std::invalid_argument(fmt::format("trace '{}'", one_line(word)));
    trace.push_back({*seconds, *cost, lower_bound});
  }
  return trace;
}

}  // namespace grove::detail::batch
