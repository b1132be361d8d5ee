// SPDX-License-Identifier: MIT
// Interfaces to observe a run and its expansions, for the log, the progress line and tests.
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
  kProgress,   // a work item was completed; very frequent, so the observer must throttle
  kBound,      // the lower bound rose
  kTree,       // a new tree was instantiated
  kIncumbent,  // a better plan was found
  kEnd,        // the search is over; the last event; not reported if there was no search
};

// Observer of a run. The base class does nothing. The threads that run the search call it, one call
// at a time. The calling thread does not search during the call, so functions should return
// quickly. References are valid only during the call. Nodes must not be kept after the end of the
// run, because their memory belongs to the run.
class RunObserver {
 public:
  virtual ~RunObserver() = default;

  // A better plan was found. If there is a search, the kIncumbent event follows, possibly after
  // other events. An observer that saves plans should do so before it returns, so that a plan is on
  // disk when it is announced.
  virtual void on_incumbent(const Plan& /*plan*/, PlanSource /*source*/,
                            const Progress& /*progress*/) {}
  virtual void on_event(RunEvent /*event*/, const Progress& /*progress*/) {}
  // The instance was proven infeasible, before any search or outside the tree search. `reason` is a
  // sentence.
  virtual void on_infeasible(std::string_view /*reason*/) {}

  // Describes the next search in a sentence. Only for methods that search more than once.
  virtual void on_note(std::string_view /*note*/) {}

  // A bound proven outside the tree search has raised the lower bound. The next kBound event
  // reports it, unless it is infinite.
  virtual void on_outside_bound(ComponentId /*by*/) {}

  // A checkpoint was written, or writing it failed.
  virtual void on_checkpoint(const CheckpointReport& /*report*/) {}

  // Called after each event. If it returns true, on_statistics() is called with the statistics of
  // the run so far.
  virtual bool wants_statistics() { return false; }
  virtual void on_statistics(const RunStatistics& /*survey*/) {}

  // For observers of trees and tests of the search (planted optimum): on_root() reports every root;
  // on_expanded() every expansion with its result and the number of the worker, from 0; on_pruned()
  // the bound at or above which open nodes are about to be dropped. In a distributed search neither
  // on_expanded() nor on_evicted() is called.
  virtual void on_root(const NodePtr& /*root*/) {}
  virtual void on_expanded(const NodePtr& /*node*/, const Expansion& /*expansion*/,
                           int /*worker*/) {}
  virtual void on_pruned(Cost /*bound*/) {}
  // An open node was evicted because memory is short. Its bound is kept until no node is live and
  // the search restarts; then each root is reported again.
  virtual void on_evicted(const NodePtr& /*node*/) {}
};

// Forwards every call to another observer. Derived classes override the functions that they change.
class ForwardingObserver : public RunObserver {
 public:
  // `next` must outlive this object.
  explicit ForwardingObserver(RunObserver& next) : next_(next) {}

  void on_incumbent(const Plan& plan, PlanSource source, const Progress& progress) override {
    next_.on_incumbent(plan, source, progress);
  }
  void on_event(RunEvent event, const Progress& progress) override {
    next_.on_event(event, progress);
  }
  void on_infeasible(std::string_view reason) override { next_.on_infeasible(reason); }
  void on_note(std::string_view note) override { next_.on_note(note); }
  void on_outside_bound(ComponentId by) override { next_.on_outside_bound(by); }
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

// Observer of node expansions. The base class does nothing. Thread-safe.
class WorkObserver {
 public:
  WorkObserver() = default;
  WorkObserver(const WorkObserver&) = delete;
  WorkObserver& operator=(const WorkObserver&) = delete;
  virtual ~WorkObserver() = default;

  // Worker number `worker` expanded `node` with the result `expansion`.
  virtual void expanded(const NodePtr& /*node*/, const Expansion& /*expansion*/, int /*worker*/) {}
  // These nodes were evicted.
  virtual void evicted(std::span<const NodePtr> /*nodes*/) {}
  // A work item was completed.
  virtual void worked() {}
};

}  // namespace grove::detail
