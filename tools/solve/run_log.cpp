// SPDX-License-Identifier: MIT
#include "tools/solve/run_log.h"

#include <algorithm>
#include <utility>

#include "model/assert.h"
#include "model/limits.h"

namespace grove::detail {
namespace {

constexpr double kRowInterval_s = 0.5;  // minimum; the interval is a tenth of the elapsed time
constexpr double kProgressInterval_s = 0.1;
constexpr std::int64_t kRowInterval_nodes = 1000;

// Returns the importance of an event for its row; rarer events are more important.
int importance(RunEvent event) {
  switch (event) {
    case RunEvent::kIncumbent:
      return 3;
    case RunEvent::kBound:
      return 2;
    case RunEvent::kTree:
      return 1;
    case RunEvent::kProgress:
    case RunEvent::kEnd:
      break;
  }
  return 0;
}

}  // namespace

RunLog::RunLog(LogFormat& format, Clock::time_point start, const Options& options)
    : format_(format), start_(start), options_(options), tree_(options.tree_nodes) {}

double RunLog::seconds() const {
  return std::chrono::duration<double>(options_.now() - start_).count();
}

void RunLog::on_incumbent(const Plan&, PlanSource source, const Progress&) {
  event_ = RunEvent::kIncumbent;
  source_ = source;
}

void RunLog::on_event(RunEvent event, const Progress& reported) {
  Progress progress = reported;
  if (progress.lower_bound >= kInfiniteCost) progress.lower_bound = causes_.bound();  // infeasible
  if (importance(event) > importance(event_)) event_ = event;
  causes_.update(progress);
  const bool news = event_ != RunEvent::kProgress || progress.nodes_expanded != last_row_nodes_;
  const bool is_due = row_is_due(progress);
  statistics_are_due_ = is_due || event == RunEvent::kEnd;
  if (event == RunEvent::kIncumbent || (event == RunEvent::kEnd && news) || is_due)
    return row(progress);
  if (event == RunEvent::kProgress) show_progress(progress);
}

void RunLog::on_outside_bound(ComponentId by) {
  causes_.outside(by);
}

// For expansions on other ranks the cause is only known as "tree", because they report the number
// of expanded nodes but not the expansions.
void RunLog::BoundCauses::update(const Progress& progress) {
  if (progress.lower_bound <= bound_) return;
  const bool is_known = receives_expansions_ || progress.nodes_expanded == 0;
  const std::optional<ComponentId> outside_source = std::exchange(pending_, std::nullopt);
  rises_[outside_source ? name_of(*outside_source)
         : is_known     ? in_tree_
                        : "tree"] += progress.lower_bound - bound_;
  GROVE_CHECK(std::ranges::all_of(rises_, [](const auto& rise) { return rise.second > 0; }),
              "each cause has raised the bound");
  bound_ = progress.lower_bound;
}

void RunLog::BoundCauses::expanded(const Expansion& expansion) {
  receives_expansions_ = true;
  in_tree_ = expansion.branching ? "branching" : expansion.plan ? in_tree_ : "wdg";
}

bool RunLog::row_is_due(const Progress& progress) const {
  if (!has_rows_) return true;
  if (options_.by_work)
    return progress.nodes_expanded - last_row_nodes_ >=
           std::max(kRowInterval_nodes, last_row_nodes_ / 10);
  return seconds() - last_row_s_ >=
         std::clamp(last_row_s_ / 10, kRowInterval_s, options_.longest_interval_s);
}

LogRow RunLog::row_of(const Progress& progress) const {
  return {event_, source_, progress, seconds(), resident_bytes(), causes_.rises()};
}

void RunLog::row(const Progress& progress) {
  format_.row(row_of(progress));
  causes_.clear();
  has_rows_ = true;
  event_ = RunEvent::kProgress;
  GROVE_CHECK(seconds() >= last_row_s_, "rows are in order of time");
  last_row_s_ = seconds();
  last_row_nodes_ = progress.nodes_expanded;
}

void RunLog::show_progress(const Progress& progress) {
  const double now = seconds();
  if (now - last_progress_s_ < kProgressInterval_s) return;
  last_progress_s_ = now;
  format_.progress(row_of(progress));
}

void RunLog::on_statistics(const RunStatistics& statistics) {
  format_.statistics(statistics, seconds());
}

void RunLog::on_root(const NodePtr& root) {
  if (const auto row = tree_.root(*root)) format_.root(*row, seconds());
}

void RunLog::on_expanded(const NodePtr& node, const Expansion& expansion, int worker) {
  causes_.expanded(expansion);
  if (const auto row = tree_.expanded(*node, expansion, worker)) format_.node(*row, seconds());
}

void RunLog::on_infeasible(std::string_view reason) {
  format_.infeasible(reason);
}

void RunLog::on_note(std::string_view note) {
  format_.note(note, seconds());
}

void RunLog::on_checkpoint(const CheckpointReport& report) {
  format_.checkpoint(report, seconds());
}

}  // namespace grove::detail
