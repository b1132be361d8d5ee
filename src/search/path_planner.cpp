// SPDX-License-Identifier: MIT
#include "search/path_planner.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "conflicts/sequence_split.h"
#include "planning/free_order_sipp.h"
#include "planning/sequence_constraints.h"

namespace grove::detail {
namespace {

constexpr std::size_t kMostClassesKept = 4;  // per agent, with their states

}  // namespace

PathPlanner::PathPlanner(const Problem& problem, AgentStopsCache& stops,
                         std::unique_ptr<AgentPlanner> free, bool repeatable)
    : fixed_(problem.instance.world()),
      free_(free ? std::move(free) : std::make_unique<FreeOrderSipp>(problem.instance.world())),
      optimal_(problem.instance.world()),
      timed_(problem.instance.world()),
      stops_(stops),
      repeatable_(repeatable),
      free_goals_(problem.instance.agent_count()) {}

PathOutcome PathPlanner::find(AgentIndex agent, const AgentSequencing& order, PathQuery query,
                              const Limits& limits, Path& path) {
  ++calls_;
  if (order.goals) return fixed_.find(*order.goals, query, limits, path);
  SequenceStages& goals = free_goals(agent, order, query.constraints);
  query.constraints = on_path(query.constraints);
  return free_->find(goals, query, limits, path);
}

MddBuilder::Outcome PathPlanner::optimal_paths(AgentIndex agent, const AgentSequencing& order,
                                               std::span<const Constraint> constraints, Time cost,
                                               std::size_t most_nodes, const Limits& limits,
                                               Mdd& paths) {
  return optimal_.build(free_goals(agent, order, constraints), on_path(constraints), cost,
                        most_nodes, limits, paths);
}

TimeExpandedGraphs::Outcome PathPlanner::timed_graph(AgentIndex agent, const AgentSequencing& order,
                                                     std::span<const Constraint> constraints,
                                                     Time most_cost, std::size_t most_nodes,
                                                     const Limits& limits, AgentGraph& graph) {
  return timed_.make(free_goals(agent, order, constraints), on_path(constraints), most_cost,
                     most_nodes, limits, graph);
}

Sequence PathPlanner::sequence(AgentIndex agent, const AgentSequencing& order,
                               Constraints constraints, const Path& path) {
  if (order.goals) return order.sequences.prefix;
  return realized_sequence(free_goals(agent, order, constraints), path);
}

std::optional<Split> PathPlanner::sequence_split(AgentIndex agent, const AgentSequencing& order,
                                                 Constraints constraints, const Path& path) {
  if (order.goals) return std::nullopt;
  const SequenceStages& goals = free_goals(agent, order, constraints);
  const SequenceClass& work = goals.sequence_class();
  if (!leaves_choice(goals.stops(), work)) return std::nullopt;
  return grove::detail::sequence_split(agent, goals.stops(), work, realized_sequence(goals, path));
}

// The constraints that are not about the sequence. Valid until the next call.
PathPlanner::Constraints PathPlanner::on_path(Constraints constraints) {
  if (std::ranges::none_of(constraints, is_about_sequence)) return constraints;
  on_path_.clear();
  std::ranges::remove_copy_if(constraints, std::back_inserter(on_path_), is_about_sequence);
  return on_path_;
}

SequenceStages& PathPlanner::free_goals(AgentIndex agent, const AgentSequencing& order,
                                        Constraints constraints) {
  if (std::ranges::none_of(constraints, is_about_sequence))
    return free_goals(agent, order.sequences);
  return free_goals(agent, narrowed(order.sequences, stops_.of(agent), constraints));
}

SequenceStages& PathPlanner::free_goals(AgentIndex agent, const SequenceClass& work) {
  auto& kept = free_goals_[agent];
  const auto known = std::ranges::find_if(
      kept, [&](const auto& goals) { return goals->sequence_class() == work; });
  if (known != kept.end()) {
    std::rotate(kept.begin(), known, known + 1);
  } else {
    if (kept.size() == kMostClassesKept) kept.pop_back();
    kept.insert(kept.begin(), std::make_unique<SequenceStages>(stops_.of(agent), work));
  }
  if (repeatable_) kept.front()->cost_to_go().reset();
  return *kept.front();
}

}  // namespace grove::detail
