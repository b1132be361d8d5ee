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

}  // namespace

void MethodCount::count(const batch::Row& row) {
  ++runs;
  errors += row.outcome.failed() ? 1 : 0;
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
  std::string line = fmt::format("{}/{} done; {} gone", state.work.done, total,
                                 batch::duration_text(state.elapsed_s));
  if (const auto left = batch::seconds_left(state.work); left && *left > 0)
    line += fmt::format(", about {} left", batch::duration_text(*left));
  int errors = 0;
  std::string separator = "; solved: ";
  for (const std::string& name : state.methods) {
    const MethodCount& count = state.counts.at(name);
    line += fmt::format("{}{} {}/{}", separator, name, count.solved, count.runs);
    separator = ", ";
    errors += count.errors;
  }
  if (errors > 0) line += fmt::format("; {} error{}", errors, errors == 1 ? "" : "s");
  return {state.work.done, total, std::move(line)};
}

std::string summary_table(const BenchState& state) {
  std::size_t width = std::string("method").size();
  for (const std::string& name : state.methods) width = std::max(width, name.size());
  std::string text = fmt::format("{:<{}}  {:>11}  {:>8}  {:>6}\n", "method", width, "solved/run",
                                 "median s", "errors");
  for (const std::string& name : state.methods) {
    const MethodCount& count = state.counts.at(name);
    text += fmt::format("{:<{}}  {:>11}  {:>8}  {:>6}\n", name, width,
                        fmt::format("{}/{}", count.solved, count.runs),
                        median_text(count.runtimes_s), count.errors);
  }
  return text + "median s: of all runs; one that is not solved counts as its time limit\n";
}

}  // namespace grove::detail::bench
