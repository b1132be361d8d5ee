// SPDX-License-Identifier: MIT
// *Claim: for any multipliers y >= 0, the sum of the subproblem values minus the sum of the
// multipliers is a lower bound on the cost of every plan.* Here the penalised cost of a path is its
// cost plus the multipliers of the rows that it uses, and the subproblem value of an agent is a
// lower bound on the penalised costs of all its paths. *Proof.* A plan uses each row at most once
// (relaxed_rows.cpp). Summing over all agents,
//
//   sum of values <= sum of costs + sum over rows of y * uses <= cost of the plan + sum of y.
//
// *Rounding.* All numbers are integers in units of 1 / kUnit step. The cost of a plan is a whole
// number of steps, so the bound can be rounded up.
//
// *Conditions.* A value need not be exact; it suffices that no path has a lower penalised cost
// (penalized_search.cpp). All values in the sum must have been computed under the same multipliers.
// Therefore the multipliers are updated only between rounds, while no values are being computed.
//
// *Step.* See target_level_step.h for the step length. The subgradient of a row is the number of
// its uses by the cheapest paths, minus 1. The direction is a subgradient that is smoothed over
// rounds, because consecutive subgradients tend to cancel each other.
#include "lagrangian/lagrangian_bound.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "model/assert.h"
#include "model/effort.h"

namespace grove::detail {
namespace {

constexpr int kMaxStops = 10;
constexpr std::size_t kMaxMarkBytes = std::size_t{1} << 26;  // of one agent's search
constexpr std::size_t kBytesOfMark = 16;
constexpr int kRoundsPerDualSolution = 4;                 // see store_dual_solution()
constexpr double kMinDistance = 0.02 * Penalties::kUnit;  // a smaller level distance gains nothing

}  // namespace

std::unique_ptr<LagrangianBound> LagrangianBound::make(const Instance& instance,
                                                       const AgentStopsCache& stops,
                                                       const Tuning& tuning) {
  const auto states = static_cast<std::size_t>(instance.world().state_count());
  for (const Agent& agent : instance.agents()) {
    const std::size_t stops_of_agent = agent.stops.size();
    if (stops_of_agent > kMaxStops) return nullptr;
    if ((states << stops_of_agent) * kBytesOfMark > kMaxMarkBytes) return nullptr;
  }
  return std::unique_ptr<LagrangianBound>(new LagrangianBound(instance, stops, tuning));
}

LagrangianBound::LagrangianBound(const Instance& instance, const AgentStopsCache& stops,
                                 const Tuning& tuning)
    : instance_(instance),
      tuning_(tuning),
      stops_(stops),
      rows_(instance.world(), instance.agent_count()),
      occupancy_(instance.world()),
      pairs_(instance.world(), stops_,
             {.mdd_nodes = static_cast<std::size_t>(tuning.mdd_nodes),
              .joint_mdd_nodes = static_cast<std::size_t>(tuning.joint_mdd_nodes),
              .bytes = std::size_t{256} << 20}),
      ascent_(tuning),
      solutions_{nullptr, tuning.first_dual_solution_round} {
  const auto agents = static_cast<std::size_t>(instance.agent_count());
  round_.paths.resize(agents);
  round_.values.resize(agents);
  round_.has_value.resize(agents);
  round_.missing = instance.agent_count();
}

ScaledCost LagrangianBound::known_value(AgentIndex agent) const {
  return round_.paths[agent].empty() ? kNoCost : multipliers().price(agent, round_.paths[agent]);
}

bool LagrangianBound::store_value(AgentIndex agent, ScaledCost value, Path path) {
  GROVE_CHECK(phase_ == Phase::kPricing, "values are stored only while agents are priced");
  if (round_.has_value[agent]) return false;
  GROVE_ASSERT(path.empty() || multipliers().price(agent, path) >= value,
               "a subproblem value is at most the penalised cost of the path found");
  round_.has_value[agent] = 1;
  --round_.missing;
  GROVE_CHECK(round_.missing >= 0, "each agent has at most one value in a round");
  round_.values[agent] = value;
  if (!path.empty()) round_.paths[agent] = std::move(path);
  return true;
}

ScaledCost LagrangianBound::bound_of_round() const {
  return std::accumulate(round_.values.begin(), round_.values.end(), ScaledCost{0}) -
         multipliers().sum();
}

void LagrangianBound::end_pricing() {
  GROVE_CHECK(phase_ == Phase::kPricing && round_.missing == 0,
              "a round ends when all agents have values");
  phase_ = Phase::kUpdating;
  ++rounds_;
  const ScaledCost bound = bound_of_round();
  if (bound > best_.bound && best_.records_multipliers) note_best_multipliers();
  best_.bound = std::max(best_.bound, bound);
}

void LagrangianBound::note_best_multipliers() {
  std::vector<RowMultiplier> noted;
  for (Multipliers::RowId id = 0; id < multipliers().count(); ++id)
    if (multipliers().multiplier(id) > 0)
      noted.push_back({multipliers().row(id), multipliers().multiplier(id)});
  best_.multipliers = std::move(noted);
}

bool LagrangianBound::update(Cost cutoff, const Limits& limits, std::int64_t& work) {
  GROVE_CHECK(phase_ == Phase::kUpdating, "multipliers change only between rounds");
  if (!events_.are_counted) {
    separate_conflict_rows();
    events_.are_counted = true;
    work += occupancy_.end() * instance_.agent_count() / effort::kCountedSteps;
  }
  separate_finish_rows(limits, work);
  if (!events_.pairs.empty()) return false;
  move_multipliers(cutoff);
  events_.are_counted = false;
  return true;
}

void LagrangianBound::separate_conflict_rows() {
  occupancy_.count(round_.paths);
  for (const Collision& collision : occupancy_.collisions()) {
    rows_.add(collision);
    const auto [a, b] = std::minmax(collision.a, collision.b);
    GROVE_ASSERT(a != b, "a collision has two different agents");
    const FinishTimePair pair{a, b, static_cast<Time>(round_.paths[a].size()) - 1,
                              static_cast<Time>(round_.paths[b].size()) - 1};
    if (!rows_.has(pair)) events_.pairs.push_back(pair);
  }
}

void LagrangianBound::separate_finish_rows(const Limits& limits, std::int64_t& work) {
  const std::int64_t begin = pairs_.work();
  while (!events_.pairs.empty() && pairs_.work() - begin < tuning_.lagrangian_step_work) {
    const FinishTimePair pair = events_.pairs.back();
    events_.pairs.pop_back();
    if (!rows_.has(pair) && pairs_.are_incompatible(pair, limits))
      rows_.add(pairs_.extended(pair, limits));
  }
  work += pairs_.work() - begin;
}

// After a dual solution, 1 / kRoundsPerDualSolution of the rounds so far pass before the next one,
// because the bound improves more and more slowly.
void LagrangianBound::store_dual_solution(ScaledCost bound) {
  if (rounds_ < solutions_.next_round || bound < best_.bound) return;
  solutions_.next_round = rounds_ + std::max(1, rounds_ / kRoundsPerDualSolution);
  solutions_.latest = std::make_shared<const DualSolution>(
      DualSolution{multipliers(), round_.values, round_.paths});
}

void LagrangianBound::move_multipliers(Cost cutoff) {
  const ScaledCost bound = bound_of_round();
  GROVE_CHECK(bound <= best_.bound, "the best bound is the maximum over the rounds");
  store_dual_solution(bound);
  const double squares =
      rows_.update_direction(round_.paths, occupancy_, tuning_.lagrangian_smoothing);
  const double most = static_cast<double>(cutoff) * Penalties::kUnit;
  is_stationary_ = squares <= 0;
  if (!is_stationary_) rows_.take_step(ascent_.step(static_cast<double>(bound), most, squares));
}

void LagrangianBound::begin_round(Cost known) {
  GROVE_CHECK(phase_ == Phase::kUpdating && !events_.are_counted,
              "a round begins after the update of the multipliers");
  const double hoped = static_cast<double>(best_.bound) + ascent_.level_distance();
  const bool is_futile = rounds_ > tuning_.lagrangian_min_rounds &&
                         hoped < static_cast<double>(known) * Penalties::kUnit;
  const bool is_over = is_stationary_ || ascent_.level_distance() < kMinDistance || is_futile;
  phase_ = is_over ? Phase::kEnded : Phase::kPricing;
  round_.missing = instance_.agent_count();
  std::ranges::fill(round_.has_value, std::uint8_t{0});
}

Cost LagrangianBound::lower_bound() const {
  return static_cast<Cost>((best_.bound + Penalties::kUnit - 1) / Penalties::kUnit);
}

}  // namespace grove::detail
