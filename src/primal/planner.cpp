// SPDX-License-Identifier: MIT
// *Agent order.* The first order is by individual cost, lowest first. An agent may not come to rest
// where an agent planned earlier still passes, so low-cost agents planned late would wait for
// high-cost agents, whereas high-cost agents find paths around resting agents. Measured on maps of
// 64x64 cells and den312d, 100 agents, 300 tasks: first plans cost 0.7 to 8 % more than the sum of
// individual costs; in random order 8 to 14 % more, with highest cost first 12 to 18 % more. If
// each agent that must visit another agent's destination is planned before that other agent, first
// plans cost 0.5 instead of 0.2 % more (500 agents, 3,000 tasks, warehouse). Later rounds sort by
// cost with noise (kOrderNoise).
#include "primal/planner.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "model/assert.h"

namespace grove::detail {
namespace {

constexpr double kOrderNoise = 0.5;  // noise on the costs by which later rounds sort agents
constexpr std::int64_t kEndless = std::numeric_limits<std::int64_t>::max();

}  // namespace

Planner::Planner(const Problem& problem, PrimalLowLevel& low_level, Random& random,
                 const Tuning& tuning)
    : agents_(problem.instance.agent_count()),
      low_level_(low_level),
      random_(random),
      tuning_(tuning),
      states_(Individual(), kTransitions),
      paths_(problem.instance),
      planning_(problem.instance.world(), low_level_, paths_, random_, tuning_) {}

bool Planner::plan_individually(const Limits& limits) {
  AgentIndex& next = states_.as<Individual>().next;
  GROVE_CHECK(next < agents_, "each agent is planned individually once");
  const std::int64_t before = low_level_.work();
  const bool has_path = low_level_.plan_individually(next, limits);
  individual_.work += low_level_.work() - before;
  if (!has_path) return false;
  individual_.are_minimal = individual_.are_minimal && low_level_.knows_best(next);
  individual_.sum += low_level_.individual_cost(next++);
  return next == agents_;
}

void Planner::keep_adopted(const Plan& plan) {
  std::optional<Plan>& adopted = states_.as<Individual>().adopted;
  GROVE_CHECK(!adopted || plan.cost < adopted->cost,
              "each adopted plan is cheaper than the one before");
  adopted = plan;
}

std::optional<Plan> Planner::begin_first_round() {
  Individual& individual = states_.as<Individual>();
  GROVE_CHECK(individual.next == agents_,
              "every agent has an individual path before the first round");
  std::optional<Plan> adopted = std::move(individual.adopted);
  planning_.begin(agents_by_cost(0));
  states_.enter(FirstRound{new_round()});
  return adopted;
}

void Planner::begin_later_round() {
  GROVE_CHECK(std::ranges::all_of(paths_.paths(), &Path::empty),
              "no path of the previous round is left");
  planning_.begin(agents_by_cost(kOrderNoise));
  states_.enter(LaterRound{new_round()});
}

// `noise`: a cost changes by a random fraction of at most `noise` / 2. 0: no random draws.
std::vector<AgentIndex> Planner::agents_by_cost(double noise) {
  std::vector<std::pair<double, AgentIndex>> keys;
  for (AgentIndex agent = 0; agent < agents_; ++agent) {
    const double spread = noise == 0 ? 0 : noise * (random_.unit() - 0.5);
    keys.emplace_back((1 + spread) * low_level_.individual_cost(agent), agent);
  }
  std::ranges::sort(keys);
  std::vector<AgentIndex> order;
  for (const auto& [key, agent] : keys) order.push_back(agent);
  return order;
}

bool Planner::plan(const Limits& limits, bool has_rival) {
  using Outcome = PrioritizedPlanning::Outcome;
  Round& round = this->round();
  const Outcome outcome = planning_.step(limits, has_rival ? round.label_limit : kEndless);
  if (outcome == Outcome::kPostponed) round.label_limit *= 2;
  return outcome == Outcome::kDone;
}

PlannedPaths& Planner::end_round() {
  states_.enter(Idle());
  return paths_;
}

void Planner::add_planning_work(std::int64_t work) {
  GROVE_CHECK(work >= 0, "effort never falls");
  round().planning_work += work;
}

void Planner::add_other_work(std::int64_t work) {
  GROVE_CHECK(work >= 0, "effort never falls");
  round().other_work += work;
}

}  // namespace grove::detail
