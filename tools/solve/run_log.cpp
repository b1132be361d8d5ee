// SPDX-License-Identifier: MIT
#include "tools/solve/run_log.h"

#include <algorithm>

#include "grove/model/limits.h"

namespace grove {
namespace {

constexpr double kRowInterval_s = 0.5;  // at first; then a tenth of the time gone by
constexpr double kProgressInterval_s = 0.1;
constexpr std::int64_t kRowInterval_nodes = 1000;

// The rarer the event, the more telling.
int telling(RunEvent event) {
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

RunLog::RunLog(LogFormat& format, Clock::time_point start, bool by_work, double longest_interval_s)
    : format_(format), start_(start), by_work_(by_work), longest_interval_s_(longest_interval_s) {}

double RunLog::seconds() const {
  return std::chrono::duration<double>(Clock::now() - start_).count();
}

void RunLog::on_incumbent(const Plan&, PlanSource source, const Progress&) {
  event_ = RunEvent::kIncumbent;
  source_ = source;
}

void RunLog::on_event(RunEvent event, const Progress& progress) {
  if (telling(event) > telling(event_)) event_ = event;
  const bool news = event_ != RunEvent::kProgress || progress.nodes_expanded != last_row_nodes_;
  if (event == RunEvent::kIncumbent || (event == RunEvent::kEnd && news) || row_is_due(progress))
    return row(progress);
  if (event == RunEvent::kProgress) show_progress(progress);
}

bool RunLog::row_is_due(const Progress& progress) const {
  if (!has_rows_) return true;
  if (by_work_)
    return progress.nodes_expanded - last_row_nodes_ >=
           std::max(kRowInterval_nodes, last_row_nodes_ / 10);
  return seconds() - last_row_s_ >=
         std::clamp(last_row_s_ / 10, kRowInterval_s, longest_interval_s_);
}

LogRow RunLog::row_of(const Progress& progress) const {
  return {event_, source_, progress, seconds(), resident_bytes()};
}

void RunLog::row(const Progress& progress) {
  format_.row(row_of(progress));
  has_rows_ = true;
  event_ = RunEvent::kProgress;
  last_row_s_ = seconds();
  last_row_nodes_ = progress.nodes_expanded;
}

void RunLog::show_progress(const Progress& progress) {
  const double now = seconds();
  if (now - last_progress_s_ < kProgressInterval_s) return;
  last_progress_s_ = now;
  format_.progress(row_of(progress));
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

}  // namespace grove
