// SPDX-License-Identifier: MIT
// Low level of CBS for fixed and free sequences.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "joint/time_expanded_graphs.h"
#include "model/effort.h"
#include "planning/agent_planner.h"
#include "planning/agent_stops_cache.h"
#include "planning/fixed_order_sipp.h"
#include "planning/mdd.h"
#include "search/node.h"

namespace grove::detail {

// Plans one agent under an AgentSequencing. If the sequence is fixed, the path visits the goals in
// order; otherwise the low level chooses the sequence. Keeps its workspace between calls, so reuse
// it. One thread at a time.
class PathPlanner {
 public:
  // `problem` and `stops` must outlive this object. `stops` may be shared with other objects of the
  // same thread. `free` plans agents whose sequence is free; nullptr: Grove's own low level.
  // `repeatable`: the number of labels that a call expands does not depend on earlier calls.
  PathPlanner(const Problem& problem, AgentStopsCache& stops,
              std::unique_ptr<AgentPlanner> free = nullptr, bool repeatable = false);

  // Like AgentPlanner::find(). `query` holds the agent's constraints.
  PathOutcome find(AgentIndex agent, const AgentSequencing& order, PathQuery query,
                   const Limits& limits, Path& path);

  // Like MddBuilder::build().
  MddBuilder::Outcome mdd(AgentIndex agent, const AgentSequencing& order,
                          std::span<const Constraint> constraints, Time cost, std::size_t max_nodes,
                          const Limits& limits, Mdd& paths);

  // Like TimeExpandedGraphs::make().
  TimeExpandedGraphs::Outcome timed_graph(AgentIndex agent, const AgentSequencing& order,
                                          std::span<const Constraint> constraints, Time max_cost,
                                          std::size_t max_nodes, const Limits& limits,
                                          AgentGraph& graph);

  // Returns a sequence in which `path` visits the stops. `path` must realize a sequence that
  // `order` allows.
  Sequence sequence(AgentIndex agent, const AgentSequencing& order, const Path& path);

  // Number of calls of find() so far, and number of labels that they expanded.
  std::int64_t calls() const { return calls_; }
  std::int64_t expanded() const { return fixed_.expanded() + free_->expanded(); }
  // Effort of MDDs so far; see MddBuilder::nodes().
  std::int64_t mdd_nodes() const { return mdd_builder_.nodes(); }
  // Nodes of time-expanded graphs expanded so far.
  std::int64_t timed_nodes() const { return timed_graphs_.nodes(); }
  // Effort of calls and labels; see model/effort.h.
  std::int64_t work() const { return expanded() + effort::kUnitsPerCall * calls_; }

 private:
  SequenceStages& free_goals(AgentIndex agent, const AgentSequencing& order);

  std::int64_t calls_ = 0;
  FixedOrderSipp fixed_;
  std::unique_ptr<AgentPlanner> free_;
  MddBuilder mdd_builder_;
  TimeExpandedGraphs timed_graphs_;
  AgentStopsCache& stops_;
  bool repeatable_;
  std::vector<std::unique_ptr<SequenceStages>> free_goals_;  // by AgentIndex, for the last class
};

}  // namespace grove::detail
