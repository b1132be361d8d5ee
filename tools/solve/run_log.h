// SPDX-License-Identifier: MIT
// Converts the events of a run to rows of its log.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include "tools/solve/log_format.h"

namespace grove::detail {

// Writes a row immediately for each incumbent, for each node that --log-tree selects, and at the
// end of the run if something has changed since the last row. Throttles other rows by the clock or,
// with Options::by_work, by the number of expanded nodes, so that two runs of a deterministic
// search log the same rows.
class RunLog : public RunObserver {
 public:
  using Clock = std::chrono::steady_clock;
  struct Options {
    bool by_work = false;  // throttle by expanded nodes instead of by time
    // The interval between throttled rows grows with the elapsed time, up to this many seconds.
    double longest_interval_s = std::numeric_limits<double>::infinity();
    std::int64_t tree_nodes = 0;  // log the first `tree_nodes` expanded nodes
    std::function<Clock::time_point()> now = Clock::now;
  };
  RunLog(LogFormat& format, Clock::time_point start, const Options& options);

  void on_incumbent(const Plan& plan, PlanSource source, const Progress& progress) override;
  void on_outside_bound(ComponentId by) override;
  void on_event(RunEvent event, const Progress& progress) override;
  void on_infeasible(std::string_view reason) override;
  void on_note(std::string_view note) override;
  void on_checkpoint(const CheckpointReport& report) override;
  // Returns true once after an event that made a throttled row due, and once after the end of the
  // run.
  bool wants_statistics() override { return std::exchange(statistics_are_due_, false); }
  void on_statistics(const RunStatistics& statistics) override;
  void on_root(const NodePtr& root) override;
  void on_expanded(const NodePtr& node, const Expansion& expansion, int worker) override;

 private:
  // Attributes each rise of the lower bound to its cause.
  class BoundCauses {
   public:
    // The lower bound so far.
    Cost bound() const { return bound_; }
    // The next rise is due to a bound proven outside the tree search.
    void outside(ComponentId by) { pending_ = by; }
    // If the bound rises after this expansion, the expansion is the cause, because it completed the
    // last live node with the old bound.
    void expanded(const Expansion& expansion);
    void update(const Progress& progress);
    // The rise since the last call of clear(), by cause.
    const std::map<std::string_view, Cost>& rises() const { return rises_; }
    void clear() { rises_.clear(); }

   private:
    Cost bound_ = 0;
    std::optional<ComponentId> pending_;       // source of the next rise; nullopt: the tree
    std::string_view in_tree_ = "individual";  // cause if the tree raises the bound
    bool receives_expansions_ = false;
    std::map<std::string_view, Cost> rises_;
  };

  bool row_is_due(const Progress& progress) const;
  void row(const Progress& progress);
  void show_progress(const Progress& progress);
  LogRow row_of(const Progress& progress) const;
  double seconds() const;

  LogFormat& format_;
  const Clock::time_point start_;
  const Options options_;
  TreeLog tree_;
  BoundCauses causes_;
  bool has_rows_ = false;
  bool statistics_are_due_ = false;
  RunEvent event_ = RunEvent::kProgress;  // most important event since the last row
  PlanSource source_ = PlanSource::kTree;
  double last_row_s_ = 0;
  std::int64_t last_row_nodes_ = 0;
  double last_progress_s_ = 0;
};

}  // namespace grove::detail
