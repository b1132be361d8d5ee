// SPDX-License-Identifier: MIT
// Who watches a run: the log, the progress line, tests.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "engine/bound_source.h"
#include "engine/checkpoints.h"
#include "engine/run_statistics.h"
#include "model/plan.h"
#include "primal/plan_source.h"
#include "search/expander.h"
#include "search/node.h"

namespace grove::detail {

// Where a run stands.
struct Progress {
  std::int64_t nodes_expanded = 0;
  std::int64_t nodes_open = 0;
  std::int64_t trees = 0;
  Cost lower_bound = 0;
  std::optional<Cost> incumbent;
};

enum class RunEvent : std::uint8_t {
  kProgress,   // after every expansion: throttle it
  kBound,      // the lower bound rose
  kTree,       // a new tree was instantiated
  kIncumbent,  // a better plan was found
  kEnd,        // the search is over; comes once, last
};

// Does nothing; override what is of interest. Called from the threads that run the search, one
// at a time: return quickly. References are valid during the call;
// the nodes die with the run: keep none.
class RunObserver {
 public:
  virtual ~RunObserver() = default;

  // A better plan was found; comes right before its kIncumbent. Save it, if at all, before it
  // returns: what is announced ought to be safe.
  virtual void on_incumbent(const Plan& /*plan*/, PlanSource /*source*/,
                            const Progress& /*progress*/) {}
  virtual void on_event(RunEvent /*event*/, const Progress& /*progress*/) {}
  // The instance was seen to have no plan, before any search or beside the trees; `reason` is a
  // sentence.
  virtual void on_infeasible(std::string_view /*reason*/) {}

  // What the run goes on with now, a sentence: of methods that search more than once.
  virtual void on_note(std::string_view /*note*/) {}

  // The bound, if it rises now, does so beside the tree.
  virtual void on_bound_beside(BoundSource /*by*/) {}

  // A checkpoint was written, or could not be.
  virtual void on_checkpoint(const CheckpointReport& /*report*/) {}

  // Asked after each event: true to be given a survey now, of the run up to here.
  virtual bool wants_statistics() { return false; }
  virtual void on_statistics(const RunStatistics& /*survey*/) {}

  // For who looks at the trees themselves, or tests the search's reasoning (planted optimum): every
  // root, every expansion with what it led to and the number of the worker, from 0, that did it;
  // and the bound from which on open nodes were dropped. Where ranks share a search only the roots
  // are told.
  virtual void on_root(const NodePtr& /*root*/) {}
  virtual void on_expanded(const NodePtr& /*node*/, const Expansion& /*expansion*/,
                           int /*worker*/) {}
  virtual void on_pruned(Cost /*bound*/) {}
  // An open node was given up for want of memory; the ledger keeps its bound until the search, out
  // of nodes, begins anew (each root then comes again).
  virtual void on_evicted(const NodePtr& /*node*/) {}
};

// Passes everything on to another; override what is to be more.
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
  void on_statistics(const RunStatistics& survey) override { next_.on_statistics(survey); }
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

}  // namespace grove::detail
