// SPDX-License-Identifier: MIT
#include "grove/search/path_planner.h"

namespace grove {

PathPlanner::PathPlanner(const Problem& problem, AgentStopsStore& stops)
    : fixed_(problem.instance.grid()),
      free_(problem.instance.grid()),
      optimal_(problem.instance.grid()),
      stops_(stops),
      free_goals_(problem.instance.agent_count()) {}

PathPlanner::Outcome PathPlanner::find(AgentIndex agent, const AgentOrder& order,
                                       std::span<const Constraint> constraints,
                                       const ConflictAvoidanceTable* others, Time cutoff,
                                       const Limits& limits, Path& path) {
  ++calls_;
  if (order.goals) return find_fixed(*order.goals, constraints, others, cutoff, limits, path);
  return free_.find(free_goals(agent, order.sequences), constraints, others, cutoff, limits, path);
}

PathPlanner::Outcome PathPlanner::find_fixed(const GoalSequence& goals,
                                             std::span<const Constraint> constraints,
                                             const ConflictAvoidanceTable* others, Time cutoff,
                                             const Limits& limits, Path& path) {
  switch (fixed_.find(goals, constraints, others, limits, path)) {
    case LowLevelSearch::Outcome::kFound:
      return static_cast<Time>(path.size()) - 1 <= cutoff ? Outcome::kFound : Outcome::kAbove;
    case LowLevelSearch::Outcome::kInfeasible:
      return Outcome::kInfeasible;
    case LowLevelSearch::Outcome::kStopped:
      break;
  }
  return Outcome::kStopped;
}

OptimalPathsBuilder::Outcome PathPlanner::optimal_paths(AgentIndex agent, const AgentOrder& order,
                                                        std::span<const Constraint> constraints,
                                                        Time cost, std::size_t most_nodes,
                                                        const Limits& limits, OptimalPaths& paths) {
  return optimal_.build(free_goals(agent, order.sequences), constraints, cost, most_nodes, limits,
                        paths);
}

Sequence PathPlanner::sequence(AgentIndex agent, const AgentOrder& order, const Path& path) {
  if (order.goals) return order.sequences.prefix;
  return realized_sequence(free_goals(agent, order.sequences), path);
}

FreeGoals& PathPlanner::free_goals(AgentIndex agent, const SequenceClass& work) {
  auto& goals = free_goals_[agent];
  if (!goals || !(goals->sequence_class() == work))
    goals = std::make_unique<FreeGoals>(stops_.of(agent), work);
  return *goals;
}

}  // namespace grove
