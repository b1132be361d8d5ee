// SPDX-License-Identifier: MIT
// Turns the events of a run into rows of its log.
#pragma once

#include <chrono>
#include <cstdint>
#include <limits>
#include <map>
#include <string_view>
#include <utility>

#include "tools/solve/log_format.h"

namespace grove::detail {

// Decides when a row is due: at once for a plan and for nodes of --log-tree. Other rows are
// throttled by the clock or, with `by_work`, by the number of expanded nodes, so that two runs of
// the same search log the same rows.
class RunLog : public RunObserver {
 public:
  using Clock = std::chrono::steady_clock;
  struct Options {
    bool by_work = false;
    // Intervals between rows grow with time, up to this.
    double longest_interval_s = std::numeric_limits<double>::infinity();
    std::int64_t tree_nodes = 0;  // number of expanded nodes to log
  };
  RunLog(LogFormat& format, Clock::time_point start, const Options& options);

  void on_incumbent(const Plan& plan, PlanSource source, const Progress& progress) override;
  void on_bound_beside(BoundSource by) override;
  void on_event(RunEvent event, const Progress& progress) override;
  void on_infeasible(std::string_view reason) override;
  void on_note(std::string_view note) override;
  void on_checkpoint(const CheckpointReport& report) override;
  // True with rows that are due by time or work, and at the end.
  bool wants_statistics() override { return std::exchange(statistics_are_due_, false); }
  void on_statistics(const RunStatistics& statistics) override;
  void on_root(const NodePtr& root) override;
  void on_expanded(const NodePtr& node, const Expansion& expansion, int worker) override;

 private:
  void note_bound(const Progress& progress);
  bool row_is_due(const Progress& progress) const;
  void row(const Progress& progress);
  void show_progress(const Progress& progress);
  LogRow row_of(const Progress& progress) const;
  double seconds() const;

  LogFormat& format_;
  const Clock::time_point start_;
  const Options options_;
  TreeLog tree_;
  bool has_rows_ = false;
  bool statistics_are_due_ = false;
  bool receives_expansions_ = false;
  std::optional<BoundSource> raises_;     // source of the next rise of the bound, if not the tree
  RunEvent event_ = RunEvent::kProgress;  // the most important one since the last row
  PlanSource source_ = PlanSource::kTree;
  std::string_view last_work_ = "individual";   // cause of a rise of the bound by the tree
  std::map<std::string_view, Cost> raised_by_;  // rise since the last row, by cause
  Cost bound_ = 0;
  double last_row_s_ = 0;
  std::int64_t last_row_nodes_ = 0;
  double last_progress_s_ = 0;
};

}  // namespace grove::detail
