// SPDX-License-Identifier: MIT
#include "grove/search/path_planner.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "grove/conflicts/sequence_split.h"
#include "grove/planning/sequence_constraints.h"

namespace grove {
namespace {

constexpr std::size_t kMostClassesKept = 4;  // of an agent, with their states

}  // namespace

PathPlanner::PathPlanner(const Problem& problem, AgentStopsStore& stops)
    : fixed_(problem.instance.grid()),
      free_(problem.instance.grid()),
      baseline_(make_baseline_search(problem.low_level, problem.instance.grid())),
      optimal_(problem.instance.grid()),
      stops_(stops),
      free_goals_(problem.instance.agent_count()) {}

PathPlanner::Outcome PathPlanner::find(AgentIndex agent, const AgentOrder& order,
                                       std::span<const Constraint> constraints,
                                       const ConflictAvoidanceTable* others, Time cutoff,
                                       const Limits& limits, Path& path, std::int64_t most_labels) {
  ++calls_;
  if (order.goals) return find_fixed(*order.goals, constraints, others, cutoff, limits, path);
  if (baseline_) return find_as_others_do(agent, constraints, cutoff, limits, path);
  return free_.find(free_goals(agent, order, constraints), on_path(constraints), others, cutoff,
                    limits, path, most_labels);
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

PathPlanner::Outcome PathPlanner::find_as_others_do(AgentIndex agent, Constraints constraints,
                                                    Time cutoff, const Limits& limits, Path& path) {
  switch (baseline_->find(agent, stops_.of(agent), constraints, cutoff, limits, path)) {
    case BaselineSearch::Outcome::kFound:
      return Outcome::kFound;
    case BaselineSearch::Outcome::kAbove:
      return Outcome::kAbove;
    case BaselineSearch::Outcome::kInfeasible:
      return Outcome::kInfeasible;
    case BaselineSearch::Outcome::kStopped:
      break;
  }
  return Outcome::kStopped;
}

OptimalPathsBuilder::Outcome PathPlanner::optimal_paths(AgentIndex agent, const AgentOrder& order,
                                                        std::span<const Constraint> constraints,
                                                        Time cost, std::size_t most_nodes,
                                                        const Limits& limits, OptimalPaths& paths) {
  return optimal_.build(free_goals(agent, order, constraints), on_path(constraints), cost,
                        most_nodes, limits, paths);
}

Sequence PathPlanner::sequence(AgentIndex agent, const AgentOrder& order, Constraints constraints,
                               const Path& path) {
  if (order.goals) return order.sequences.prefix;
  return realized_sequence(free_goals(agent, order, constraints), path);
}

std::optional<Split> PathPlanner::sequence_split(AgentIndex agent, const AgentOrder& order,
                                                 Constraints constraints, const Path& path) {
  if (order.goals) return std::nullopt;
  const FreeGoals& goals = free_goals(agent, order, constraints);
  const SequenceClass& work = goals.sequence_class();
  if (!leaves_choice(goals.stops(), work)) return std::nullopt;
  return grove::sequence_split(agent, goals.stops(), work, realized_sequence(goals, path));
}

// Those that are not about the sequence; until the next call.
PathPlanner::Constraints PathPlanner::on_path(Constraints constraints) {
  if (std::ranges::none_of(constraints, is_about_sequence)) return constraints;
  on_path_.clear();
  std::ranges::remove_copy_if(constraints, std::back_inserter(on_path_), is_about_sequence);
  return on_path_;
}

FreeGoals& PathPlanner::free_goals(AgentIndex agent, const AgentOrder& order,
                                   Constraints constraints) {
  if (std::ranges::none_of(constraints, is_about_sequence))
    return free_goals(agent, order.sequences);
  return free_goals(agent, narrowed(order.sequences, stops_.of(agent), constraints));
}

FreeGoals& PathPlanner::free_goals(AgentIndex agent, const SequenceClass& work) {
  auto& kept = free_goals_[agent];
  const auto known = std::ranges::find_if(
      kept, [&](const auto& goals) { return goals->sequence_class() == work; });
  if (known != kept.end()) {
    std::rotate(kept.begin(), known, known + 1);
  } else {
    if (kept.size() == kMostClassesKept) kept.pop_back();
    kept.insert(kept.begin(), std::make_unique<FreeGoals>(stops_.of(agent), work));
  }
  return *kept.front();
}

}  // namespace grove
