// SPDX-License-Identifier: MIT
// The destroy operators:
// - kAgentBased: an agent whose path costs more than its individual path, drawn with a probability
//   proportional to the difference, and agents that block its individual path, or the individual
//   path of an agent chosen so far with a delay.
// - kRandom: random agents.
// - kMapBased: agents that pass near a random place at about the same time.
// - kReducedCost, only with a dual solution: an agent whose penalised path cost exceeds its
//   subproblem value, drawn with a probability proportional to the difference (the reduced cost),
//   and agents that block the path with that value, or such a path of an agent chosen so far with a
//   delay. In contrast to kAgentBased, this operator does not select an agent that is delayed only
//   because all others would be delayed otherwise: its reduced cost is 0.
#include "primal/neighborhoods.h"

#include <algorithm>
#include <numeric>

#include "model/assert.h"
#include "planning/planned_paths.h"

namespace grove::detail {
namespace {

constexpr std::int64_t kMaxNeighborhood = 8;  // agents
// Failures per agent after which the maximum size grows by its initial value.
constexpr std::int64_t kGrowthFailures = 2;
constexpr std::int64_t kMaxGrowth = 4;  // maximum factor of this growth
constexpr double kDestroyDecay = 0.99;  // decay factor of the operators' weights per iteration
// Approximate probability of an operator without gain.
constexpr double kDestroyMinProbability = 0.02;
constexpr int kAgentBasedTries = 8;  // tries to fill a kAgentBased or kReducedCost neighbourhood
constexpr Time kMapBasedWindow = 8;  // time steps before and after the chosen time

// Blocking agents are sought for paths of the dual solution with delays of 0 to kLate - 1 steps.
constexpr Time kLate = 3;

}  // namespace

const std::vector<AgentIndex>& Neighborhoods::choose() {
  const int agents = problem_.instance.agent_count();
  chosen_.clear();
  const std::int64_t spread = max_size() - tuning_.min_neighborhood;
  wanted_ = std::min<std::int64_t>(
      agents, tuning_.min_neighborhood + random_.below(std::max<std::int64_t>(spread, 0) + 1));
  kind_ = choose_kind();
  if (kind_ == kAgentBased) add_delayed();
  if (kind_ == kMapBased) add_around_spot();
  if (kind_ == kReducedCost) add_by_reduced_cost();
  if (std::ssize(chosen_) < kFew) add_anyone();
  GROVE_CHECK(!chosen_.empty() && std::ssize(chosen_) <= wanted_,
              "a neighbourhood has from 1 to `wanted_` agents");
  random_.shuffle(chosen_);
  return chosen_;
}

// Maximum size of a neighbourhood. It grows after every kGrowthFailures failures per agent, because
// larger neighbourhoods can gain where small ones no longer do (variable neighbourhood search:
// Mladenovic and Hansen 1997).
std::int64_t Neighborhoods::max_size() const {
  const std::int64_t times = 1 + failures_ / (kGrowthFailures * problem_.instance.agent_count());
  return kMaxNeighborhood * std::min<std::int64_t>(times, kMaxGrowth);
}

Neighborhoods::Kind Neighborhoods::choose_kind() {
  const int kinds = this->kinds();
  const double sum = std::accumulate(weights_.begin(), weights_.begin() + kinds, 0.0);
  double at = random_.unit() * sum * (1 + kinds * kDestroyMinProbability);
  for (int kind = 0; kind < kinds; ++kind) {
    at -= weights_[static_cast<std::size_t>(kind)] + sum * kDestroyMinProbability;
    if (at < 0) return static_cast<Kind>(kind);
  }
  return kRandom;
}

void Neighborhoods::reward(Cost gain) {
  failures_ = gain > 0 ? 0 : failures_ + 1;
  double& weight = weights_[kind_];
  weight = kDestroyDecay * weight + (1 - kDestroyDecay) * static_cast<double>(gain);
}

void Neighborhoods::add(AgentIndex agent) {
  if (agent == ReservationTable::kNoAgent || full()) return;
  if (std::ranges::find(chosen_, agent) == chosen_.end()) chosen_.push_back(agent);
}

void Neighborhoods::add_anyone() {
  while (!full()) add(random_.below(problem_.instance.agent_count()));
}

void Neighborhoods::add_delayed() {
  const AgentIndex agent = some_delayed_agent();
  if (agent == ReservationTable::kNoAgent) return;
  add(agent);
  add_blocking_agents(agent, low_level_.individual_path(agent), 0);
  const Time delay = paths_.cost(agent) - low_level_.individual_cost(agent);
  GROVE_ASSERT(delay > 0, "only a delayed agent is drawn");
  for (int tries = 0; tries < kAgentBasedTries && !full(); ++tries) {
    const AgentIndex member = chosen_[random_.below(chosen_.size())];
    add_blocking_agents(member, low_level_.individual_path(member), random_.below(delay + 1));
  }
}

AgentIndex Neighborhoods::some_delayed_agent() {
  Cost sum = 0;
  const int agents = problem_.instance.agent_count();
  for (AgentIndex agent = 0; agent < agents; ++agent)
    sum += paths_.cost(agent) - low_level_.individual_cost(agent);
  if (sum <= 0) return ReservationTable::kNoAgent;
  Cost at = random_.below(sum);
  for (AgentIndex agent = 0; agent < agents; ++agent) {
    at -= paths_.cost(agent) - low_level_.individual_cost(agent);
    if (at < 0) return agent;
  }
  return ReservationTable::kNoAgent;
}

// Adds the agents with which `agent` would collide on `path` with a delay of `late` steps.
void Neighborhoods::add_blocking_agents(AgentIndex agent, const Path& path, Time late) {
  for_each_blocking_agent(problem_.instance.world(), paths_.reservations(), agent, path, late,
                          [&](AgentIndex other) {
                            add(other);
                            return !full();
                          });
}

void Neighborhoods::add_by_reduced_cost() {
  update_reduced_costs();
  const AgentIndex agent = agent_by_reduced_cost();
  if (agent == ReservationTable::kNoAgent) return;
  add(agent);
  add_blocking_agents(agent, wanted_path(agent), 0);
  for (int tries = 0; tries < kAgentBasedTries && !full(); ++tries) {
    const AgentIndex member = chosen_[random_.below(chosen_.size())];
    add_blocking_agents(member, wanted_path(member), random_.below(kLate));
  }
}

void Neighborhoods::update_reduced_costs() {
  const DualSolution& dual_solution = *low_level_.dual_solution();
  const auto agents = paths_.paths().size();
  auto& [prices, reduced_cost, versions] = reduced_costs_;
  if (prices != low_level_.price_changes()) {
    prices = low_level_.price_changes();
    reduced_cost.resize(agents);
    versions.assign(agents, 0);
  }
  for (AgentIndex agent = 0; agent < std::ssize(paths_.paths()); ++agent) {
    if (versions[agent] == paths_.version(agent)) continue;
    versions[agent] = paths_.version(agent);
    reduced_cost[agent] =
        std::max<ScaledCost>(0, dual_solution.multipliers.price(agent, paths_.path(agent)) -
                                    dual_solution.values[agent]);
  }
}

AgentIndex Neighborhoods::agent_by_reduced_cost() {
  const std::vector<ScaledCost>& costs = reduced_costs_.of;
  const ScaledCost sum = std::accumulate(costs.begin(), costs.end(), ScaledCost{0});
  if (sum <= 0) return ReservationTable::kNoAgent;
  ScaledCost at = random_.below(sum);
  AgentIndex agent = 0;
  while ((at -= costs[agent]) >= 0) ++agent;
  return agent;
}

const Path& Neighborhoods::wanted_path(AgentIndex agent) const {
  const Path& path = low_level_.dual_solution()->paths[agent];
  return path.empty() ? low_level_.individual_path(agent) : path;
}

// Chooses a random time step of a random agent's path. Adds the agents that are within
// kMapBasedWindow steps of that time on places near the agent's place, in breadth-first order of
// places.
void Neighborhoods::add_around_spot() {
  const World& world = problem_.instance.world();
  const Path& path = paths_.path(random_.below(problem_.instance.agent_count()));
  const auto time = static_cast<Time>(random_.below(path.size()));
  auto& [queue, reached_by, number] = near_;
  reached_by.resize(static_cast<std::size_t>(world.place_count()), 0);
  ++number;
  queue.assign(1, world.place(path[time]));
  reached_by[queue.front()] = number;
  for (std::size_t next = 0; next < queue.size() && !full(); ++next) {
    const Place place = queue[next];
    add_visitors(place, time);
    for (Place neighbor : world.neighbors(place)) {
      if (reached_by[neighbor] == number) continue;
      reached_by[neighbor] = number;
      queue.push_back(neighbor);
    }
  }
}

void Neighborhoods::add_visitors(Place place, Time time) {
  for (const ReservationTable::Stay& stay : paths_.reservations().stays(place))
    if (stay.first <= time + kMapBasedWindow && stay.last >= time - kMapBasedWindow)
      add(stay.agent);
}

}  // namespace grove::detail
