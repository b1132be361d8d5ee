// SPDX-License-Identifier: MIT
// The low level, whatever a tree leaves open.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "joint/time_expanded_graphs.h"
#include "planning/agent_planner.h"
#include "planning/agent_stops_cache.h"
#include "planning/fixed_order_sipp.h"
#include "planning/mdd.h"
#include "search/node.h"
#include "search/work.h"

namespace grove::detail {

// Plans one agent under an AgentSequencing: through its goals where the order is fixed, else
// choosing the order. Workspace of one thread: reuse it, do not share it.
class PathPlanner {
 public:
  // `problem` and `stops` must outlive this; `stops` may be shared with others of the same thread.
  // `free` plans where the order is open; null: Grove's own low level. `repeatable`: the labels
  // that a call expands do not depend on the calls before.
  PathPlanner(const Problem& problem, AgentStopsCache& stops,
              std::unique_ptr<AgentPlanner> free = nullptr, bool repeatable = false);

  // As AgentPlanner::find, with the agent's constraints of all kinds in the query.
  PathOutcome find(AgentIndex agent, const AgentSequencing& order, PathQuery query,
                   const Limits& limits, Path& path);

  // As MddBuilder::build.
  MddBuilder::Outcome optimal_paths(AgentIndex agent, const AgentSequencing& order,
                                    std::span<const Constraint> constraints, Time cost,
                                    std::size_t most_nodes, const Limits& limits, Mdd& paths);

  // As TimeExpandedGraphs::make.
  TimeExpandedGraphs::Outcome timed_graph(AgentIndex agent, const AgentSequencing& order,
                                          std::span<const Constraint> constraints, Time most_cost,
                                          std::size_t most_nodes, const Limits& limits,
                                          AgentGraph& graph);

  // A sequence that `path`, which must realize one that the order and the constraints leave, visits
  // its stops in.
  Sequence sequence(AgentIndex agent, const AgentSequencing& order,
                    std::span<const Constraint> constraints, const Path& path);

  // A split of the class that the order and the constraints leave, on the next stop of `path`,
  // which must obey both; none if they leave no choice.
  std::optional<Split> sequence_split(AgentIndex agent, const AgentSequencing& order,
                                      std::span<const Constraint> constraints, const Path& path);

  // Calls of find(), and labels expanded by them, so far.
  std::int64_t calls() const { return calls_; }
  std::int64_t expanded() const { return fixed_.expanded() + free_->expanded(); }
  // Nodes of sets of optimal paths, so far.
  std::int64_t optimal_nodes() const { return optimal_.nodes(); }
  // Nodes of timed graphs, so far.
  std::int64_t timed_nodes() const { return timed_.nodes(); }
  // Calls and labels; see work.h.
  std::int64_t work() const { return expanded() + work::kPerCall * calls_; }

 private:
  using Constraints = std::span<const Constraint>;

  SequenceStages& free_goals(AgentIndex agent, const AgentSequencing& order,
                             Constraints constraints);
  SequenceStages& free_goals(AgentIndex agent, const SequenceClass& work);
  Constraints on_path(Constraints constraints);

  std::int64_t calls_ = 0;
  FixedOrderSipp fixed_;
  std::unique_ptr<AgentPlanner> free_;
  MddBuilder optimal_;
  TimeExpandedGraphs timed_;
  AgentStopsCache& stops_;
  bool repeatable_;
  std::vector<std::vector<std::unique_ptr<SequenceStages>>>
      free_goals_;  // by AgentIndex: of the classes asked for last, the last of all in front
  std::vector<Constraint> on_path_;
};

}  // namespace grove::detail
