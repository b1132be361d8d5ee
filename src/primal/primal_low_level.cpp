// SPDX-License-Identifier: MIT
#include "primal/primal_low_level.h"

#include <stdexcept>
#include <utility>

#include "model/assert.h"
#include "search/node.h"
#include "sequencing/cost_matrix.h"
#include "sequencing/good_sequence.h"

namespace grove::detail {
namespace {

constexpr std::int64_t kMaxPricedLabels = 1 << 18;

}  // namespace

PrimalLowLevel::PrimalLowLevel(const Problem& problem, AgentStopsCache& stops)
    : problem_(problem),
      stops_(stops),
      low_level_(problem.instance.world()),
      in_order_(problem.instance.agent_count()),
      goals_(problem.instance.agent_count()),
      own_paths_(problem.instance.agent_count()) {}

SequenceStages& PrimalLowLevel::goals(AgentIndex agent) {
  auto& goals = goals_[agent];
  if (!goals) goals = std::make_unique<SequenceStages>(stops_.of(agent), SequenceClass());
  return *goals;
}

bool PrimalLowLevel::plan_individually(AgentIndex agent, const Limits& limits) {
  Path& path = own_paths_[agent];
  if (!path.empty()) return true;
  ++calls_;
  switch (low_level_.find(goals(agent), {}, limits, path)) {
    case PathOutcome::kFound:
      return true;
    case PathOutcome::kStopped:
      return !limits.stop_requested() && follow_good_sequence(agent, limits);
    case PathOutcome::kAboveCutoff:
    case PathOutcome::kInfeasible:
      break;
  }
  throw std::logic_error("internal error: an agent that can reach all its cells has no path");
}

// Individual planning along one good sequence, for an agent with too many sequences to find the
// best one.
bool PrimalLowLevel::follow_good_sequence(AgentIndex agent, const Limits& limits) {
  AgentStops& stops = stops_.of(agent);
  const CostMatrix& matrix = stops.cost_to_go().matrix();
  in_order_[agent] = std::make_unique<CostToGo>(CostToGo::in_order(matrix, good_sequence(matrix)));
  goals_[agent] = std::make_unique<SequenceStages>(stops, SequenceClass(), *in_order_[agent]);
  ++calls_;
  const PathQuery query{.known_sequences_only = true};
  return low_level_.find(goals(agent), query, limits, own_paths_[agent]) == PathOutcome::kFound;
}

PathOutcome PrimalLowLevel::find(AgentIndex agent, const PathQuery& query, const Limits& limits,
                                 Path& path) {
  ++calls_;
  const PathOutcome outcome = low_level_.find(goals(agent), query, limits, path);
  GROVE_ASSERT(
      outcome != PathOutcome::kFound || (path.front() == problem_.instance.agent(agent).start &&
                                         std::ssize(path) - 1 <= query.cutoff),
      "a path begins at the agent's start and costs at most the cutoff");
  return outcome;
}

void PrimalLowLevel::use(std::shared_ptr<const DualSolution> dual_solution) {
  if (priced_) labels_before_ += priced_->labels();
  dual_solution_ = std::move(dual_solution);
  ++price_changes_;
  priced_.emplace(dual_solution_->multipliers.penalties());
}

void PrimalLowLevel::improve(AgentIndex agent, const ReservationTable& others, Time latest,
                             const Limits& limits, Path& path) {
  const Multipliers& multipliers = dual_solution_->multipliers;
  priced_->improve(goals(agent), multipliers.on_finish(agent), others, latest,
                   multipliers.price(agent, path), kMaxPricedLabels, limits, path);
  GROVE_ASSERT(std::ssize(path) - 1 <= latest, "an improved path finishes by `latest`");
}

Plan PrimalLowLevel::plan(const std::vector<Path>& paths) {
  Plan plan;
  for (AgentIndex agent = 0; agent < problem_.instance.agent_count(); ++agent) {
    const Path& path = paths[agent];
    const Sequence sequence = realized_sequence(goals(agent), path);
    plan.agents.push_back(agent_plan(problem_.instance, agent, sequence, path));
    GROVE_ASSERT(plan.agents.back().cost < std::ssize(path),
                 "an agent finishes by the end of its path");
    plan.cost += plan.agents.back().cost;
  }
  return plan;
}

}  // namespace grove::detail
