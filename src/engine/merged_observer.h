// SPDX-License-Identifier: MIT
// Reports several consecutive searches to one observer as one search.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "engine/run_observer.h"
#include "model/limits.h"

namespace grove::detail {

// Forwards the events of several consecutive searches to one observer, as if they were one search.
class MergedObserver {
 public:
  explicit MergedObserver(RunObserver& next) : next_(next) {}

  void begin_search() { before_ = last_; }
  void incumbent(const Plan& plan, PlanSource source, const Progress& progress) {
    is_better_ = !last_.incumbent || plan.cost < *last_.incumbent;
    if (!is_better_) return;
    last_.incumbent = plan.cost;
    next_.on_incumbent(plan, source, of_whole(progress));
  }
  void event(RunEvent event, const Progress& progress) {
    searched_ = true;
    const Cost bound = last_.lower_bound;
    last_ = of_whole(progress);
    const bool is_news = event == RunEvent::kIncumbent ? is_better_
                         : event == RunEvent::kBound   ? last_.lower_bound > bound
                                                       : true;
    ends_ = event == RunEvent::kEnd;
    if (!ends_) next_.on_event(is_news ? event : RunEvent::kProgress, last_);
  }
  // Always requests the statistics at the end of a search, because they are added to those of later
  // searches.
  bool wants_statistics() { return ends_ || next_.wants_statistics(); }
  void statistics(RunStatistics statistics) {
    for (const auto& [name, count] : done_) statistics.whole.counts[name] += count;
    if (ends_) done_ = statistics.whole.counts;
    for (const auto& [name, count] : outside_) statistics.whole.counts[name] += count;
    next_.on_statistics(statistics);
  }
  // Reports an event between two searches. `counts`: of the run so far, without these searches.
  void event_outside(RunEvent what, const Progress& progress,
                     std::map<std::string, std::int64_t> counts) {
    outside_ = std::move(counts);
    begin_search();
    event(what, progress);
    if (!next_.wants_statistics()) return;
    RunStatistics whole;
    whole.whole.memory.process = static_cast<std::int64_t>(resident_bytes());
    statistics(std::move(whole));
  }
  void root(const NodePtr& root) { next_.on_root(root); }
  void expanded(const NodePtr& node, const Expansion& expansion, int worker) {
    next_.on_expanded(node, expansion, worker);
  }
  void note(std::string_view note) { next_.on_note(note); }
  void outside_bound(ComponentId by) { next_.on_outside_bound(by); }
  void infeasible(std::string_view reason) { next_.on_infeasible(reason); }
  void end() {
    if (searched_) next_.on_event(RunEvent::kEnd, last_);
  }

 private:
  Progress of_whole(Progress progress) const {
    progress.nodes_expanded += before_.nodes_expanded;
    progress.trees += before_.trees;
    progress.lower_bound = std::max(last_.lower_bound, progress.lower_bound);
    progress.incumbent = last_.incumbent;
    return progress;
  }

  RunObserver& next_;
  Progress before_;  // at the start of the current search
  Progress last_;
  std::map<std::string, std::int64_t> done_;     // counts of the earlier searches
  std::map<std::string, std::int64_t> outside_;  // see event_outside()
  bool is_better_ = false;
  bool searched_ = false;
  bool ends_ = false;  // a search is ending
};

// Observer of one of these searches, for the same instance or for one with the same agents whose
// plans and bounds it converts.
class Stage : public RunObserver {
 public:
  explicit Stage(MergedObserver& merged) : merged_(merged) { merged.begin_search(); }

  void on_incumbent(const Plan& plan, PlanSource source, const Progress& progress) override {
    merged_.incumbent(of_whole(plan), source, of_whole(progress));
  }
  void on_event(RunEvent event, const Progress& progress) override {
    merged_.event(event, of_whole(progress));
  }
  void on_outside_bound(ComponentId by) override { merged_.outside_bound(by); }
  void on_infeasible(std::string_view reason) override { merged_.infeasible(reason); }
  bool wants_statistics() override { return merged_.wants_statistics(); }
  void on_statistics(const RunStatistics& statistics) override { merged_.statistics(statistics); }
  void on_root(const NodePtr& root) override { merged_.root(root); }
  void on_expanded(const NodePtr& node, const Expansion& expansion, int worker) override {
    merged_.expanded(node, expansion, worker);
  }

 private:
  virtual Plan of_whole(const Plan& plan) const { return plan; }
  // The bound on the original instance that a bound of this search proves.
  virtual Cost proven_by(Cost bound) const { return bound; }

  Progress of_whole(Progress progress) const {
    progress.lower_bound = proven_by(progress.lower_bound);
    return progress;
  }

  MergedObserver& merged_;
};

}  // namespace grove::detail
