// SPDX-License-Identifier: MIT
#include "router.h"

#include <stdexcept>
#include <utility>

#include "grove/detail/search/node.h"

namespace grove::detail {
namespace {

constexpr std::int64_t kMostPricedLabels = 1 << 18;

}  // namespace

Router::Router(const Problem& problem, AgentStopsStore& stops)
    : problem_(problem),
      stops_(stops),
      low_level_(problem.instance.world()),
      goals_(problem.instance.agent_count()),
      own_paths_(problem.instance.agent_count()) {}

FreeGoals& Router::goals(AgentIndex agent) {
  auto& goals = goals_[agent];
  if (!goals) goals = std::make_unique<FreeGoals>(stops_.of(agent), SequenceClass());
  return *goals;
}

bool Router::meet(AgentIndex agent, const Limits& limits) {
  if (!own_paths_[agent].empty()) return true;
  ++calls_;
  switch (low_level_.find(goals(agent), {}, limits, own_paths_[agent])) {
    case PathOutcome::kFound:
      return true;
    case PathOutcome::kStopped:
      return false;
    case PathOutcome::kAbove:
    case PathOutcome::kInfeasible:
      break;
  }
  throw std::logic_error("internal error: an agent that can reach all its cells has no path");
}

PathOutcome Router::find(AgentIndex agent, const PathQuery& query, const Limits& limits,
                         Path& path) {
  ++calls_;
  return low_level_.find(goals(agent), query, limits, path);
}

void Router::use(std::shared_ptr<const PriceList> prices) {
  if (priced_) labels_before_ += priced_->labels();
  prices_ = std::move(prices);
  ++price_changes_;
  priced_.emplace(prices_->tariff.penalties());
}

void Router::improve(AgentIndex agent, const Reservations& others, Time latest,
                     const Limits& limits, Path& path) {
  const Tariff& tariff = prices_->tariff;
  priced_->improve(goals(agent), tariff.on_finish(agent), others, latest, tariff.price(agent, path),
                   kMostPricedLabels, limits, path);
}

Plan Router::plan(const std::vector<Path>& paths) {
  Plan plan;
  for (AgentIndex agent = 0; agent < problem_.instance.agent_count(); ++agent) {
    const Path& path = paths[agent];
    const Sequence sequence = realized_sequence(goals(agent), path);
    plan.agents.push_back(agent_plan(problem_.instance, agent, sequence, path));
    plan.cost += plan.agents.back().cost;
  }
  return plan;
}

}  // namespace grove::detail
