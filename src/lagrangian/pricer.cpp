// SPDX-License-Identifier: MIT
#include "lagrangian/pricer.h"

#include <algorithm>
#include <utility>

#include "lagrangian/penalized_search.h"
#include "model/effort.h"

namespace grove::detail {
namespace {

constexpr std::int64_t kMaxLabels = std::int64_t{1} << 23;

}  // namespace

void Pricer::perform(PricingJob& job, const Limits& limits) {
  for (AgentIndex agent = job.first; agent < job.end; ++agent) {
    const ScaledCost known = job.known[static_cast<std::size_t>(agent - job.first)];
    const std::int64_t labels = search_.labels();
    Path path;
    job.values.push_back(known == kNoCost ? first_value(agent, limits, path)
                                          : price_below(known, agent, limits, path));
    job.paths.push_back(std::move(path));
    job.work += (search_.labels() - labels) / effort::kPricedLabels + 1;
  }
}

SequenceStages& Pricer::goals(AgentIndex agent) {
  if (static_cast<std::size_t>(agent) >= goals_.size()) goals_.resize(agent + std::size_t{1});
  if (!goals_[agent])
    goals_[agent] = std::make_unique<SequenceStages>(stops_.of(agent), SequenceClass{});
  return *goals_[agent];
}

// Computes the value of an agent without a known path, so that no known cost can serve as the
// cutoff. Tries increasing cutoffs, starting one step above the least cost without penalties,
// because hardly any value is much higher.
ScaledCost Pricer::first_value(AgentIndex agent, const Limits& limits, Path& path) {
  const ScaledCost least = ScaledCost{min_cost(goals(agent), limits)} * Penalties::kUnit;
  ScaledCost price = 0;
  for (ScaledCost more = Penalties::kUnit; path.empty(); more *= 4) {
    const ScaledCost below = std::min(least + more, PenalizedSearch::kMaxPenaltyCost);
    price = price_below(below, agent, limits, path);
    if (price < below || below == PenalizedSearch::kMaxPenaltyCost) break;
  }
  return price;
}

ScaledCost Pricer::price_below(ScaledCost below, AgentIndex agent, const Limits& limits,
                               Path& path) {
  SequenceStages& goals = this->goals(agent);
  CostToGo& cost_to_go = goals.cost_to_go();
  if (ScaledCost{cost_to_go.outside_bound()} * Penalties::kUnit < below)
    cost_to_go.extend(static_cast<Time>(below / Penalties::kUnit), limits);
  return search_.search(goals, multipliers_.on_finish(agent), below, kMaxLabels, limits, &path);
}

}  // namespace grove::detail
