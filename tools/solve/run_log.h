// SPDX-License-Identifier: MIT
// The events of a run as rows of its log.
#pragma once

#include <chrono>
#include <limits>

#include "tools/solve/log_format.h"

namespace grove {

// Decides when a row is due: at once for a plan, else throttled by the clock, or, with `by_work`,
// by the number of nodes expanded, so that two runs of the same search log the same rows.
class RunLog : public RunObserver {
 public:
  using Clock = std::chrono::steady_clock;
  // Rows get rarer with time, but are never further apart than `longest_interval_s`.
  RunLog(LogFormat& format, Clock::time_point start, bool by_work,
         double longest_interval_s = std::numeric_limits<double>::infinity());

  void on_incumbent(const Plan& plan, PlanSource source, const Progress& progress) override;
  void on_event(RunEvent event, const Progress& progress) override;
  void on_infeasible(std::string_view reason) override;
  void on_note(std::string_view note) override;
  void on_checkpoint(const CheckpointReport& report) override;

 private:
  bool row_is_due(const Progress& progress) const;
  void row(const Progress& progress);
  void show_progress(const Progress& progress);
  LogRow row_of(const Progress& progress) const;
  double seconds() const;

  LogFormat& format_;
  const Clock::time_point start_;
  const bool by_work_;
  const double longest_interval_s_;
  bool has_rows_ = false;
  RunEvent event_ = RunEvent::kProgress;  // the most telling one since the last row
  PlanSource source_ = PlanSource::kTree;
  double last_row_s_ = 0;
  std::int64_t last_row_nodes_ = 0;
  double last_progress_s_ = 0;
};

}  // namespace grove
