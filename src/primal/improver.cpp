// SPDX-License-Identifier: MIT
#include "primal/improver.h"

#include <algorithm>
#include <utility>

#include "model/assert.h"
#include "primal/visit_orders.h"

namespace grove::detail {
namespace {

// Rounds of traffic-guided LaCAM without a better plan after which LNS takes over.
constexpr int kGuidedRoundsWithoutGain = 4;
// Traffic-guided LaCAM starts if the plan costs at least this fraction more than the sum of
// individual costs.
constexpr double kMinLossForGuidance = 0.1;

constexpr std::uint64_t kSeeds = std::uint64_t{1} << 32;

}  // namespace

Improver::Improver(const Problem& problem, PrimalLowLevel& low_level,
                   const IndividualCosts& individual, Random& random, std::uint64_t seed,
                   bool has_lacam, const Tuning& tuning)
    : problem_(problem),
      low_level_(low_level),
      individual_(individual),
      random_(random),
      seed_(seed),
      tuning_(tuning),
      states_(first_state(has_lacam)),
      paths_(problem.instance),
      lns_(problem, low_level_, paths_, random_, tuning_) {}

Improver::States Improver::first_state(bool has_lacam) {
  if (has_lacam) return States(FirstPlan(), kTransitions);
  return States(Waiting(), kTransitions);
}

Improver::Guidance Improver::guidance() const {
  switch (state()) {
    case State::kWaiting:
      return Guidance::kImpossible;
    case State::kLacam:
      return Guidance::kPossible;
    case State::kGuided:
      return Guidance::kUsed;
    case State::kLns:
      break;
  }
  return states_.as<Lns>().guidance;
}

bool Improver::step(const Limits& limits) {
  GROVE_CHECK(is_active(), "an improver that waits gets no effort");
  if (state() == State::kLacam) return seek_first_plan(limits);
  if (state() == State::kGuided) return guide(limits);
  return improve(limits);
}

bool Improver::seek_first_plan(const Limits& limits) {
  using Outcome = LacamWithRestarts::Outcome;
  std::unique_ptr<LacamWithRestarts>& lacam = states_.as<FirstPlan>().lacam;
  if (!lacam)
    lacam = std::make_unique<LacamWithRestarts>(problem_, individual_orders(), seed_,
                                                tuning_.lacam_first_steps);
  const std::int64_t before = lacam->steps();
  const Outcome outcome =
      lacam->run(limits, std::max<std::int64_t>(1, tuning_.primal_step_work / agents()));
  joint_search_.first_plan_steps += lacam->steps() - before;
  if (outcome == Outcome::kFound) {
    start_from(*lacam->plan(), PlanSource::kLacam);  // deletes `lacam`
    return true;
  }
  // Ends LaCAM if memory is short, so that the rest of the run can use it.
  if (outcome == Outcome::kExhausted || (outcome == Outcome::kStopped && !limits.stop_requested()))
    states_.enter(Waiting());
  return false;
}

bool Improver::guide(const Limits& limits) {
  using Outcome = TrafficGuidedLacam::Outcome;
  auto& [lacam, rounds_without_gain] = states_.as<Guided>();
  const Outcome outcome = lacam->run(limits, tuning_.primal_step_work);
  GROVE_CHECK(lacam->work() >= joint_search_.guided_work, "effort never falls");
  joint_search_.guided_work = lacam->work();
  joint_search_.guided_steps = lacam->joint_steps();
  if (outcome == Outcome::kWorking || limits.stop_requested()) return false;
  ++rounds_without_gain;
  bool gain = false;
  if (outcome == Outcome::kFound) {
    const Plan& plan = lacam->plan();
    gain = plan.cost < paths_.cost();
    if (gain) {
      put(plan, PlanSource::kLacam);
      rounds_without_gain = 0;
    }
    lacam->learn(plan);
  }
  // Ends LaCAM if memory is short, so that the rest of the run can use it.
  if (outcome == Outcome::kStopped || rounds_without_gain >= kGuidedRoundsWithoutGain)
    states_.enter(Lns{Guidance::kUsed});
  return gain;
}

bool Improver::improve(const Limits& limits) {
  lns_.step(limits);
  if (paths_.cost() >= least_cost_) return false;
  source_ = PlanSource::kLns;
  least_cost_ = paths_.cost();
  return true;
}

void Improver::start_from(const Plan& plan, PlanSource source) {
  put(plan, source);
  if (state() == State::kGuided) return;
  if (should_guide(plan))
    states_.enter(guided_by(plan));
  else
    states_.enter(Lns{guidance()});
}

void Improver::put(const Plan& plan, PlanSource source) {
  paths_.clear();
  for (AgentIndex agent = 0; agent < agents(); ++agent)
    paths_.put(agent, walked_path(problem_.instance, agent, plan.agents[agent]));
  GROVE_CHECK(paths_.cost() == plan.cost, "the costs of a plan's paths add up to its cost");
  begin_plan(source);
}

void Improver::take_over(PlannedPaths& planned) {
  paths_.clear();
  for (AgentIndex agent = 0; agent < agents(); ++agent) paths_.put(agent, planned.take(agent));
  GROVE_CHECK(planned.cost() == 0 && planned.reservations().count() == 0,
              "all paths are taken over");
  begin_plan(PlanSource::kPrioritizedPlanning);
  states_.enter(Lns{guidance()});
}

void Improver::begin_plan(PlanSource source) {
  source_ = source;
  least_cost_ = paths_.cost();
  lns_.begin(individual_.sum);
}

bool Improver::should_guide(const Plan& plan) const {
  return guidance() == Guidance::kPossible &&
         static_cast<double>(plan.cost) >=
             (1 + kMinLossForGuidance) * static_cast<double>(individual_.sum);
}

Improver::Guided Improver::guided_by(const Plan& plan) {
  const double mean_cost = static_cast<double>(individual_.sum) / agents();
  Guided guided{std::make_unique<TrafficGuidedLacam>(problem_, individual_orders(), mean_cost,
                                                     random_.below(kSeeds), tuning_)};
  guided.lacam->learn(plan);
  return guided;
}

// The sequences of the individual paths, with distinct last stops (separate_ends()).
std::vector<Sequence> Improver::individual_orders() const {
  std::vector<Sequence> orders;
  for (AgentIndex agent = 0; agent < agents(); ++agent)
    orders.push_back(low_level_.individual_order(agent));
  separate_ends(problem_.instance, orders);
  return orders;
}

}  // namespace grove::detail
