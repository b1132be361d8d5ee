// SPDX-License-Identifier: MIT
// All that a run knows beside its nodes, where that is.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "engine/central_bounds.h"
#include "engine/central_trees.h"
#include "engine/checkpoint.h"
#include "engine/live_nodes.h"
#include "engine/run_events.h"
#include "engine/solve.h"
#include "planning/agent_stops_cache.h"
#include "search/forest.h"
#include "search/tree_record.h"

namespace grove::detail {

// The ledger, the trees and the observer of a run, from its beginning, or a checkpoint, to the
// answer. For one thread, but for what says otherwise.
class RunState {
 public:
  // All must outlive this. The nodes of trees are made in `pool`.
  RunState(const Problem& problem, const SolveOptions& options, const Limits& limits,
           RunObserver& observer, NodePool& pool, LiveNodes& nodes);

  // Those who expand nodes turn to these, from any thread.
  CentralBounds& ledger() { return ledger_; }
  const CentralBounds& ledger() const { return ledger_; }
  CentralTrees& trees() { return trees_; }
  RunEvents& announcements() { return announcements_; }
  // What the first tree found out about the agents' stops, for workers to begin with.
  const AgentStopsCache& stops() const { return stops_; }

  // Before all else: the plan to start from, and the first tree.
  void begin();
  // In place of begin(): takes over what a checkpoint knows, and makes its trees again; the roots
  // by their number. Then push the nodes, and what was given up, and call restored(). None if a
  // limit struck: the plan and the bound are known, but there is nothing to search. Throws
  // InputError if the trees that come first here are others.
  std::optional<std::vector<NodePtr>> restore(const CheckpointHeader& header);
  void restored();

  // For a checkpoint, in which so many trees, the first ones, count as instantiated. From any
  // thread.
  CheckpointHeader checkpoint_header(std::int64_t trees, Cost evicted_bound);
  // When no worker is at work any more: tells the observer that this is the end; the answer, with
  // the counts of trees.
  void end() { announcements_.event(RunEvent::kEnd); }
  Solution conclude() const;

 private:
  Progress progress() const;
  std::int64_t nodes_before() const;

  const Instance& instance_;
  const SolveOptions& options_;
  const Limits& limits_;
  LiveNodes& nodes_;
  AgentStopsCache stops_;  // the forest's
  const std::unique_ptr<Forest> forest_;
  Trees restored_trees_;
  RunEvents announcements_;
  CentralBounds ledger_;
  CentralTrees trees_;

  const Limits::Clock::time_point started_ = limits_.now();
  bool resumed_ = false;
  CheckpointHeader before_;  // what earlier runs did: the counters and the time
};

}  // namespace grove::detail
