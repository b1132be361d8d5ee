// SPDX-License-Identifier: MIT
#include "search/path_planner.h"

#include <utility>

#include "planning/free_order_sipp.h"

namespace grove::detail {

PathPlanner::PathPlanner(const Problem& problem, AgentStopsCache& stops,
                         std::unique_ptr<AgentPlanner> free, bool repeatable)
    : fixed_(problem.instance.world()),
      free_(free ? std::move(free) : std::make_unique<FreeOrderSipp>(problem.instance.world())),
      mdd_builder_(problem.instance.world()),
      timed_graphs_(problem.instance.world()),
      stops_(stops),
      repeatable_(repeatable),
      free_goals_(problem.instance.agent_count()) {}

PathOutcome PathPlanner::find(AgentIndex agent, const AgentSequencing& order, PathQuery query,
                              const Limits& limits, Path& path) {
  ++calls_;
  if (order.goals) return fixed_.find(*order.goals, query, limits, path);
  return free_->find(free_goals(agent, order), query, limits, path);
}

MddBuilder::Outcome PathPlanner::mdd(AgentIndex agent, const AgentSequencing& order,
                                     std::span<const Constraint> constraints, Time cost,
                                     std::size_t max_nodes, const Limits& limits, Mdd& paths) {
  return mdd_builder_.build(free_goals(agent, order), constraints, cost, max_nodes, limits, paths);
}

TimeExpandedGraphs::Outcome PathPlanner::timed_graph(AgentIndex agent, const AgentSequencing& order,
                                                     std::span<const Constraint> constraints,
                                                     Time max_cost, std::size_t max_nodes,
                                                     const Limits& limits, AgentGraph& graph) {
  return timed_graphs_.make(free_goals(agent, order), constraints, max_cost, max_nodes, limits,
                            graph);
}

Sequence PathPlanner::sequence(AgentIndex agent, const AgentSequencing& order, const Path& path) {
  if (order.goals) return order.sequences.prefix;
  return realized_sequence(free_goals(agent, order), path);
}

SequenceStages& PathPlanner::free_goals(AgentIndex agent, const AgentSequencing& order) {
  auto& goals = free_goals_[agent];
  if (!goals || goals->sequence_class() != order.sequences)
    goals = std::make_unique<SequenceStages>(stops_.of(agent), order.sequences);
  if (repeatable_) goals->cost_to_go().reset();
  return *goals;
}

}  // namespace grove::detail
