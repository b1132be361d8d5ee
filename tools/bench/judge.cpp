// SPDX-License-Identifier: MIT
#include "tools/bench/judge.h"

#include <fmt/format.h>

#include <cstring>
#include <string_view>

#include "grove/io/input_error.h"
#include "grove/io/plan_file.h"
#include "grove/io/text_file.h"
#include "grove/model/check.h"

namespace grove::bench {
namespace {

constexpr const char* kInterrupt = "interrupt";
constexpr const char* kTimeLimit = "time limit";
constexpr std::string_view kErrorMark = "grove: error: ";

template <typename Map>
std::optional<typename Map::mapped_type> find(const Map& map, const char* name) {
  const auto it = map.find(name);
  return it == map.end() ? std::nullopt : std::optional(it->second);
}

std::string why_failed(const ChildEnd& end, const std::filesystem::path& said) {
  switch (end.kind) {
    case ChildEnd::Kind::kExited:
      if (end.code == 0) return "";
      return fmt::format("ended with exit code {}{}", end.code, last_words(said));
    case ChildEnd::Kind::kSignalled:
      return fmt::format("ended by signal {} ({})", end.code, ::strsignal(end.code));
    case ChildEnd::Kind::kTooLong:
      return fmt::format("did not end; killed after {:.0f} s", end.wall_s);
    case ChildEnd::Kind::kCancelled:
      return kInterrupt;
  }
  return "";
}

void add_stats(Outcome& outcome, const Stats& stats) {
  outcome.roots = find(stats.counts, "roots_generated");
  outcome.rtsp_calls = find(stats.counts, "rtsp_calls");
  outcome.nodes = find(stats.counts, "nodes_expanded");
  outcome.low_level_calls = find(stats.counts, "low_level_calls");
  outcome.peak_memory_mb = find(stats.measures, "peak_memory_mb");
  outcome.version = find(stats.texts, "version").value_or("");
}

Outcome outcome_of(const Instance& instance, const Solution& solution) {
  Outcome outcome;
  outcome.omega = solution.omega.to_string();
  add_stats(outcome, solution.stats);
  if (solution.plan) {
    if (const auto violations = check(instance, solution, 1); !violations.empty()) {
      outcome.error = fmt::format("the plan is wrong: {}: {}", violations[0].place,
                                  one_line(violations[0].message));
      return outcome;
    }
    outcome.cost = solution.plan->cost;
  } else if (solution.status != Status::kUnknown && solution.status != Status::kInfeasible) {
    outcome.error = fmt::format("claims to be {} without a plan", to_string(solution.status));
    return outcome;
  }
  outcome.error = find(solution.stats.texts, "stopped_by").value_or("");
  if (outcome.error == kInterrupt) return outcome;
  outcome.status = to_string(solution.status);
  outcome.solved = solution.plan.has_value() && outcome.error.empty();
  if (solution.status != Status::kInfeasible) outcome.lower_bound = solution.lower_bound;
  return outcome;
}

}  // namespace

std::string last_words(const std::filesystem::path& said) {
  try {
    const std::string text = read_text(said);
    const auto lines = split_lines(text);
    if (lines.empty()) return "";
    std::string_view last = lines.back();
    if (last.starts_with(kErrorMark)) last.remove_prefix(kErrorMark.size());
    return ": " + one_line(last);
  } catch (const InputError&) {
    return "";
  }
}

Outcome judged(const ChildEnd& end, double time_limit_s, const Instance& instance,
               const std::filesystem::path& plan_file, const std::filesystem::path& said) {
  Outcome outcome;
  outcome.error = why_failed(end, said);
  if (!outcome.error.empty()) return outcome;
  try {
    outcome = outcome_of(instance, read_solution(plan_file, instance));
    if (outcome.solved && end.wall_s > time_limit_s) {
      outcome.solved = false;
      outcome.error = kTimeLimit;
    }
    return outcome;
  } catch (const InputError& error) {
    outcome.error = fmt::format("the plan file is wrong: {}", error.what());
    return outcome;
  }
}

bool was_interrupted(const Outcome& outcome) {
  return outcome.failed() && outcome.error == kInterrupt;
}

}  // namespace grove::bench
