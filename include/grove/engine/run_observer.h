// SPDX-License-Identifier: MIT
// Who watches a run: the log, the progress line, tests.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "grove/engine/checkpoints.h"
#include "grove/model/plan.h"
#include "grove/primal/plan_source.h"
#include "grove/search/expander.h"
#include "grove/search/node.h"

namespace grove {

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
  // The instance was seen to have no plan before any search; `reason` is a sentence.
  virtual void on_infeasible(std::string_view /*reason*/) {}

  // What the run goes on with now, a sentence: of methods that search more than once.
  virtual void on_note(std::string_view /*note*/) {}

  // A checkpoint was written, or could not be.
  virtual void on_checkpoint(const CheckpointReport& /*report*/) {}

  // For tests of the search's reasoning (planted optimum): every root, every expansion with what it
  // led to, and the bound from which on open nodes were dropped.
  virtual void on_root(const NodePtr& /*root*/) {}
  virtual void on_expanded(const NodePtr& /*node*/, const Expansion& /*expansion*/) {}
  virtual void on_pruned(Cost /*bound*/) {}
  // An open node was given up for want of memory; the ledger keeps its bound until the search, out
  // of nodes, begins anew (each root then comes again).
  virtual void on_evicted(const NodePtr& /*node*/) {}
};

}  // namespace grove
