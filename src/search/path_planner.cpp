// SPDX-License-Identifier: MIT
#include "grove/search/path_planner.h"

namespace grove {

using Outcome = LowLevelSearch::Outcome;

PathPlanner::PathPlanner(const Problem& problem)
    : problem_(problem),
      fixed_(problem.instance.grid()),
      free_(problem.instance.grid()),
      stops_(problem.instance.agent_count()),
      free_goals_(problem.instance.agent_count()) {}

Outcome PathPlanner::find(AgentIndex agent, const AgentOrder& order,
                          std::span<const Constraint> constraints,
                          const ConflictAvoidanceTable* others, const Limits& limits, Path& path) {
  if (order.goals) return fixed_.find(*order.goals, constraints, others, limits, path);
  FreeGoals& goals = free_goals(agent, order.sequences);
  switch (free_.find(goals, constraints, others, kNever, limits, path)) {
    case FreeLowLevelSearch::Outcome::kFound:
      return Outcome::kFound;
    case FreeLowLevelSearch::Outcome::kInfeasible:
    case FreeLowLevelSearch::Outcome::kAbove:  // above kNever: there is none
      return Outcome::kInfeasible;
    case FreeLowLevelSearch::Outcome::kStopped:
      break;
  }
  return Outcome::kStopped;
}

Sequence PathPlanner::sequence(AgentIndex agent, const AgentOrder& order, const Path& path) {
  if (order.goals) return order.sequences.prefix;
  return realized_sequence(free_goals(agent, order.sequences), path);
}

FreeGoals& PathPlanner::free_goals(AgentIndex agent, const SequenceClass& work) {
  auto& stops = stops_[agent];
  auto& goals = free_goals_[agent];
  if (!stops) stops = std::make_unique<AgentStops>(problem_.instance, problem_.distances, agent);
  if (!goals || !(goals->sequence_class() == work))
    goals = std::make_unique<FreeGoals>(*stops, work);
  return *goals;
}

}  // namespace grove
