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
  if (row.outcome.status == batch::kUnsuitable) {
    ++unsuitable;
    return;
  }
  ++runs;
  errors += row.outcome.failed() ? 1 : 0;
  wrong += row.outcome.status == batch::kWrongPlan ? 1 : 0;
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
    errors += count.errors + count.wrong;
  }
  if (errors > 0) line += fmt::format("; {} error{}", errors, errors == 1 ? "" : "s");
  return {state.work.done, total, std::move(line)};
}

std::string summary_table(const BenchState& state) {
  std::size_t width = std::string("method").size();
  int wrong = 0, claimed = 0, unsuitable = 0;
  for (const std::string& name : state.methods) {
    width = std::max(width, name.size());
    const MethodCount& count = state.counts.at(name);
    wrong += count.wrong;
    claimed += count.claimed;
    unsuitable += count.unsuitable;
  }
  std::string text = fmt::format("{:<{}}  {:>11}  {:>8}  {:>6}", "method", width, "solved/run",
                                 "median s", "errors");
  const auto add = [&](int all, const std::string& value) {
    if (all > 0) text += fmt::format("  {:>10}", value);
  };
  const auto add_others = [&](const auto& of_wrong, const auto& of_claimed, const auto& of_others) {
    add(wrong, fmt::format("{}", of_wrong));
    add(claimed, fmt::format("{}", of_claimed));
    add(unsuitable, fmt::format("{}", of_others));
    text += "\n";
  };
  add_others("wrong", "claimed", "unsuitable");
  for (const std::string& name : state.methods) {
    const MethodCount& count = state.counts.at(name);
    text += fmt::format("{:<{}}  {:>11}  {:>8}  {:>6}", name, width,
                        fmt::format("{}/{}", count.solved, count.runs),
                        median_text(count.runtimes_s), count.errors);
    add_others(count.wrong, count.claimed, count.unsuitable);
  }
  text += "median s: of all runs; one that is not solved counts as its time limit\n";
  if (wrong > 0) text += "wrong: a plan that is none; which and why is in the table, column error\n";
  if (claimed > 0) text += "claimed: the solver says that it has a plan, and shows none\n";
  if (unsuitable > 0) text += "unsuitable: instances that the method is not for, left out\n";
  return text;
}

}  // namespace grove::detail::bench
