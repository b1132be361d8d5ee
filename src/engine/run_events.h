// SPDX-License-Identifier: MIT
// Passes the events of a run to its observer, one at a time.
#pragma once

#include <functional>
#include <mutex>
#include <span>
#include <string_view>
#include <utility>

#include "engine/run_observer.h"

namespace grove::detail {

// Passes one event at a time to the observer, with the progress at that time. Thread-safe, except
// for set_statistics_source() and bound_is_known().
class RunEvents : public WorkObserver {
 public:
  // `observer` and everything that `progress` reads must outlive this object.
  RunEvents(RunObserver& observer, std::function<Progress()> progress)
      : observer_(observer), progress_(std::move(progress)) {}
  // Sets the function that makes the statistics, for an observer that requests them. Must be called
  // before the search; any thread can then call `statistics`.
  void set_statistics_source(std::function<RunStatistics()> statistics) {
    statistics_source_ = std::move(statistics);
  }

  void expanded(const NodePtr& node, const Expansion& expansion, int worker) override;
  void evicted(std::span<const NodePtr> nodes) override;
  void worked() override { event(RunEvent::kProgress); }

  void event(RunEvent event);
  // Reports the lower bound if it is finite and exceeds the bound reported last.
  void bound(Cost lower_bound);
  // Calls `prove`, which applies a bound proven outside the tree search and returns the lower
  // bound, and reports that bound if it rose. No other event is reported in between.
  void prove_outside_trees(ComponentId by, const std::function<Cost()>& prove);
  void infeasible(std::string_view reason);
  // Treats `lower_bound` as reported. Must be called before the search.
  void bound_is_known(Cost lower_bound) { announced_bound_ = lower_bound; }
  // Reports a new incumbent. Must be called before the nodes that it prunes are dropped.
  void incumbent(const Plan& plan, PlanSource source);
  void root(const NodePtr& root);
  void checkpoint(const CheckpointReport& report);

 private:
  void bound_locked(Cost lower_bound);
  void notify(RunEvent event, const Progress& progress);

  RunObserver& observer_;
  const std::function<Progress()> progress_;
  std::function<RunStatistics()> statistics_source_;  // may be empty
  std::mutex mutex_;
  Cost announced_bound_ = 0;  // guarded by mutex_
};

}  // namespace grove::detail
