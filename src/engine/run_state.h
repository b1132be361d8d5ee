// SPDX-License-Identifier: MIT
// State of a run except its nodes, which can be in this process or distributed over ranks.
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

// Bounds, trees and observer of a run, from its start or a checkpoint to the solution. One thread
// at a time, except where a function says otherwise.
class RunState {
 public:
  // All arguments must outlive this object. The nodes of the trees are made in `pool`.
  RunState(const Problem& problem, const SolveOptions& options, const Limits& limits,
           RunObserver& observer, NodePool& pool, LiveNodes& nodes);

  // Objects for the threads that expand nodes. Thread-safe.
  CentralBounds& shared_bounds() { return shared_bounds_; }
  const CentralBounds& shared_bounds() const { return shared_bounds_; }
  CentralTrees& trees() { return trees_; }
  RunEvents& run_events() { return run_events_; }
  // The agents' stops that were computed for the first tree; the workers' caches start with them.
  const AgentStopsCache& stops() const { return stops_; }

  // Posts the start plan and instantiates the first tree. Must be called first, unless restore() is
  // called instead.
  void begin();
  // Restores the data of a checkpoint and makes its trees again. Called instead of begin(). Returns
  // the roots by tree number; the caller must then push the nodes, record the evicted bound, and
  // call restored(). Returns nullopt if a limit was reached: then plan and bound are restored, and
  // the run must not search. Throws InputError if the first trees of the forest are not those of
  // the checkpoint.
  std::optional<std::vector<NodePtr>> restore(const CheckpointHeader& header);
  void restored();

  // Returns the header of a checkpoint that records the first `trees` trees as instantiated.
  // Thread-safe.
  CheckpointHeader checkpoint_header(std::int64_t trees, Cost evicted_bound);
  // Must be called after all workers have stopped. end() reports the end to the observer.
  // conclude() returns the solution, including the counts of the trees.
  void end() { run_events_.event(RunEvent::kEnd); }
  Solution conclude() const;

 private:
  Progress progress() const;
  std::int64_t nodes_before() const;

  const Instance& instance_;
  const SolveOptions& options_;
  const Limits& limits_;
  LiveNodes& nodes_;
  AgentStopsCache stops_;  // used by the forest
  const std::unique_ptr<Forest> forest_;
  Trees restored_trees_;
  RunEvents run_events_;
  CentralBounds shared_bounds_;
  CentralTrees trees_;

  const Limits::Clock::time_point started_ = limits_.now();
  bool resumed_ = false;
  CheckpointHeader before_;  // counters and time of earlier runs
};

}  // namespace grove::detail
