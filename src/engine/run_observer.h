// SPDX-License-Identifier: MIT
// Interfaces to observe a run, for the log, the progress line and tests, and its expansions.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "engine/checkpoints.h"
#include "engine/run_statistics.h"
#include "engine/shared_bounds.h"
#include "model/plan.h"
#include "primal/plan_source.h"
#include "search/expander.h"
#include "search/node.h"

namespace grove::detail {

// Progress of a run.
struct Progress {
  std::int64_t nodes_expanded = 0;
  std::int64_t nodes_open = 0;
  std::int64_t trees = 0;
  Cost lower_bound = 0;
  std::optional<Cost> incumbent;
};

enum class RunEvent : std::uint8_t {
  kProgress,   // after every work item: throttle it
  kBound,      // the lower bound rose
  kTree,       // a new tree was instantiated
  kIncumbent,  // a better plan was found
  kEnd,        // the search is over; comes once, last
};

// Base class that does nothing; override what is needed. Called from the threads that run the
// search, one at a time: return quickly. References are valid during the call. The nodes end with
// the run: do not keep any.
class RunObserver {
 public:
  virtual ~RunObserver() = default;

  // A better plan was found; comes right before its kIncumbent. To save the plan, do so before
  // returning: an announced plan should be safe.
  virtual void on_incumbent(const Plan& /*plan*/, PlanSource /*source*/,
                            const Progress& /*progress*/) {}
  virtual void on_event(RunEvent /*event*/, const Progress& /*progress*/) {}
  // The instance was proven infeasible, before any search or outside the trees. `reason` is a
  // sentence.
  virtual void on_infeasible(std::string_view /*reason*/) {}

  // For methods that search more than once: a sentence that describes the next search.
  virtual void on_note(std::string_view /*note*/) {}

  // A rise of the bound is about to be reported that was proven outside the tree search.
  virtual void on_bound_beside(BoundSource /*by*/) {}

  // A checkpoint was written, or writing it failed.
  virtual void on_checkpoint(const CheckpointReport& /*report*/) {}

  // Called after each event. If it returns true, on_statistics() is called with the statistics of
  // the run so far.
  virtual bool wants_statistics() { return false; }
  virtual void on_statistics(const RunStatistics& /*statistics*/) {}

  // For observers of the trees, and for tests of the search (planted optimum): every root; every
  // expansion with its result and the number of the worker, from 0; and the bound from which on
  // open nodes were dropped. If ranks share a search, only the roots are reported.
  virtual void on_root(const NodePtr& /*root*/) {}
  virtual void on_expanded(const NodePtr& /*node*/, const Expansion& /*expansion*/,
                           int /*worker*/) {}
  virtual void on_pruned(Cost /*bound*/) {}
  // An open node was evicted because memory is short. Its bound is kept until the search has no
  // nodes left and restarts. Then each root is reported again.
  virtual void on_evicted(const NodePtr& /*node*/) {}
};

// Forwards everything to another observer; override what is to be added.
class ForwardingObserver : public RunObserver {
 public:
  // `next` must outlive this.
  explicit ForwardingObserver(RunObserver& next) : next_(next) {}

  void on_incumbent(const Plan& plan, PlanSource source, const Progress& progress) override {
    next_.on_incumbent(plan, source, progress);
  }
  void on_event(RunEvent event, const Progress& progress) override {
    next_.on_event(event, progress);
  }
  void on_infeasible(std::string_view reason) override { next_.on_infeasible(reason); }
  void on_note(std::string_view note) override { next_.on_note(note); }
  void on_bound_beside(BoundSource by) override { next_.on_bound_beside(by); }
  void on_checkpoint(const CheckpointReport& report) override { next_.on_checkpoint(report); }
  bool wants_statistics() override { return next_.wants_statistics(); }
  void on_statistics(const RunStatistics& statistics) override { next_.on_statistics(statistics); }
  void on_root(const NodePtr& root) override { next_.on_root(root); }
  void on_expanded(const NodePtr& node, const Expansion& expansion, int worker) override {
    next_.on_expanded(node, expansion, worker);
  }
  void on_pruned(Cost bound) override { next_.on_pruned(bound); }
  void on_evicted(const NodePtr& node) override { next_.on_evicted(node); }

 protected:
  RunObserver& next() { return next_; }

 private:
  RunObserver& next_;
};

// Events of node expansion. Base class that does nothing. Thread-safe.
class WorkObserver {
 public:
  WorkObserver() = default;
  WorkObserver(const WorkObserver&) = delete;
  WorkObserver& operator=(const WorkObserver&) = delete;
  virtual ~WorkObserver() = default;

  // `worker` expanded a node, with this result.
  virtual void expanded(const NodePtr& /*node*/, const Expansion& /*expansion*/, int /*worker*/) {}
  // These nodes were evicted.
  virtual void evicted(std::span<const NodePtr> /*nodes*/) {}
  // A work item was completed.
  virtual void worked() {}
};

}  // namespace grove::detail
