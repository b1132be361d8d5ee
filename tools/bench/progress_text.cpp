// SPDX-License-Identifier: MIT
#include "tools/bench/progress_text.h"

#include <fmt/format.h>

#include <algorithm>

namespace grove::detail::bench {
namespace {

std::string median_text(std::vector<double> values) {
  if (values.empty()) return "-";
  std::ranges::sort(values);
  const std::size_t half = values.size() / 2;
  const double median =
      values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
  return fmt::format("{:.2f}", median);
}

// Aligns the first column to the left and the other columns to the right.
std::string table_text(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths(rows.front().size());
  for (const auto& row : rows)
    for (std::size_t k = 0; k < row.size(); ++k) widths[k] = std::max(widths[k], row[k].size());
  std::string text;
  for (const auto& row : rows) {
    text += fmt::format("{:<{}}", row[0], widths[0]);
    for (std::size_t k = 1; k < row.size(); ++k) text += fmt::format("  {:>{}}", row[k], widths[k]);
    text += '\n';
  }
  return text;
}

std::string refuted_text(const std::vector<batch::FalseClaim>& claims) {
  constexpr std::size_t kShown = 10;
  std::string text;
  for (std::size_t k = 0; k < std::min(kShown, claims.size()); ++k)
    text +=
        fmt::format("refuted: {} on {} {}\n", claims[k].method, claims[k].instance, claims[k].what);
  if (claims.size() > kShown)
    text += fmt::format("refuted: {} more; grove report lists all\n", claims.size() - kShown);
  return text;
}

}  // namespace

void MethodCount::count(const batch::Row& row) {
  if (row.outcome.status == batch::kUnsupported) {
    ++unsupported;
    return;
  }
  ++runs;
  errors += row.outcome.failed() ? 1 : 0;
  wrong += row.outcome.status == batch::kInvalidPlan ? 1 : 0;
  claimed += row.outcome.status == batch::kClaimed ? 1 : 0;
  solved += row.outcome.solved ? 1 : 0;
  runtimes_s.push_back(row.runtime_s());
}

void BenchState::count(const batch::Row& row) {
  counts[row.run.settings.method].count(row);
  ++work.done;
  --work.left;
  work.done_s += row.wall_s;
}

batch::ProgressText progress_text(const BenchState& state) {
  const int total = state.work.done + state.work.left;
  std::string line = fmt::format("{}/{} done; {} elapsed", state.work.done, total,
                                 batch::duration_text(state.elapsed_s));
  if (const auto left = batch::seconds_left(state.work); left && *left > 0)
    line += fmt::format(", about {} left", batch::duration_text(*left));
  int errors = 0;
  std::string separator = "; solved: ";
  for (const std::string& name : state.methods) {
    const MethodCount& count = state.counts.at(name);
    line += fmt::format("{}{} {}/{}", separator, name, count.solved, count.runs);
    separator = ", ";
    errors += count.errors + count.wrong;
  }
  if (errors > 0) line += fmt::format("; {} error{}", errors, errors == 1 ? "" : "s");
  return {state.work.done, total, std::move(line)};
}

std::string summary_table(const BenchState& state) {
  std::vector<std::string> header{"method", "solved/run", "median s", "errors"};
  std::map<std::string, std::vector<std::string>> lines;
  for (const std::string& name : state.methods) {
    const MethodCount& count = state.counts.at(name);
    lines[name] = {name, fmt::format("{}/{}", count.solved, count.runs),
                   median_text(count.runtimes_s), std::to_string(count.errors)};
  }
  std::string legend =
      "median s: over all runs; a run that is not solved counts as its time limit\n";
  // Adds a column unless its value is 0 for all methods.
  const auto add = [&](const char* title, const char* meaning, const auto& value) {
    const auto has_some = [&](const std::string& name) { return value(name) > 0; };
    if (std::ranges::none_of(state.methods, has_some)) return;
    header.emplace_back(title);
    for (const std::string& name : state.methods)
      lines[name].push_back(std::to_string(value(name)));
    legend += fmt::format("{}: {}\n", title, meaning);
  };
  add("invalid", "invalid plans; the column error of the table has the reason",
      [&](const std::string& name) { return state.counts.at(name).wrong; });
  add("claimed", "the solver reports a plan but wrote none",
      [&](const std::string& name) { return state.counts.at(name).claimed; });
  add("refuted", "a claimed cost or bound is impossible; see the list below",
      [&](const std::string& name) {
        return std::ranges::count(state.false_claims, name, &batch::FalseClaim::method);
      });
  add("unsupported", "instances that the method does not support, excluded",
      [&](const std::string& name) { return state.counts.at(name).unsupported; });
  std::vector<std::vector<std::string>> rows{header};
  for (const std::string& name : state.methods) rows.push_back(lines[name]);
  return table_text(rows) + legend + refuted_text(state.false_claims);
}

}  // namespace grove::detail::bench
