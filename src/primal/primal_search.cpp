// SPDX-License-Identifier: MIT
// Schedule of the primal search: individual planning of every agent (its best path without the
// others), then a first plan, then large neighbourhood search (LNS) from that plan.
//
// *Rounds.* LNS improves a plan quickly at first and then stalls in a local optimum; different
// seeds end in different optima. Therefore a new round starts, with prioritised planning, when LNS
// has spent as much effort without success as the round took to reach its best plan, and has made
// at least max(kStallNeighborhoods, kStallNeighborhoodsPerAgent * agents) iterations since then.
//
// *Definition.* W is the effort of individual planning for all agents (individual_planning_work_).
//
// *First plan.* Prioritised planning has a head start: until its first failure, and for an effort
// of at most pp_head_start*W, it gets all effort. On instances that are not dense, prioritised
// planning ends within 1.5 W, with plans much cheaper than LaCAM's, which cost 1.1 to 3.5 times the
// sum of individual costs. After the head start, prioritised planning and LaCAM share the effort
// equally until one of them has a plan. A long low-level call of prioritised planning is postponed
// and repeated with twice the label limit, because a call that proves that an agent is enclosed can
// take longer than the tree search needs for a small instance.
//
// *Both continue.* If LaCAM finds a plan first (mostly within 2 W), LNS takes over that plan and
// LaCAM's half of the effort. Prioritised planning keeps the other half, because its plan, if it
// finds one, is mostly much cheaper. In the first round that plan replaces the current plan only if
// it is cheaper. Measured on room-64-64-8, 100 agents, 300 tasks: prioritised planning found a plan
// of cost 28,118 after an effort of 330,000 units, LaCAM one of cost 30,979 after 40,000 units,
// which LNS had reduced to 30,964 when prioritised planning ended. In the first round a plan
// adopted from another search does not end prioritised planning either. In later rounds prioritised
// planning shares the effort with the LNS of the previous round in the same way, so no round waits
// for a plan that is possibly never found.
//
// *Dense instances.* If the plan costs much more than the sum of individual costs, traffic-guided
// LaCAM (traffic_guided_lacam.cpp) continues from it, round by round, as long as it finds cheaper
// plans. LNS starts only afterwards, because it changes too few agents at a time to resolve a jam.
// On warehouse-10-20-10-2-1 with 900 agents, guided LaCAM reduced the cost from 206,729 to 115,468
// in six seconds, LNS only from 204,322 to 197,747 in four. Prioritised planning mostly fails on
// such instances. Therefore, once there is a plan and prioritised planning has spent
// pp_long_attempt*W, it gets only 1/9 of the effort (kOtherWorkPerLatePlanningWork).
//
// *Tree search.* The tree search waits for a much cheaper plan from prioritised planning or guided
// LaCAM (expects_plan()), but no longer than its root takes. The root examines all pairs of agents,
// so its effort is estimated as min(pp_long_attempt, W/root_work_per_individual_planning)*W.
//
// *Agent order.* The first order is by individual cost, lowest first. An agent may not come to rest
// where an agent planned earlier still passes, so low-cost agents planned late would wait for
// high-cost agents, whereas high-cost agents find paths around resting agents. Measured on maps of
// 64x64 cells and den312d, 100 agents, 300 tasks: first plans cost 0.7 to 8 % more than the sum of
// individual costs; in random order 8 to 14 % more, with highest cost first 12 to 18 % more. If
// each agent that must visit another agent's destination was planned before that agent, first plans
// cost 0.5 instead of 0.2 % more (500 agents, 3,000 tasks, warehouse). Later rounds sort by cost
// with noise (kOrderNoise).
//
// *Dual solutions* of the Lagrangian bound guide only LNS. Prioritised planning with penalties, or
// from the paths of the dual solution, yields cheaper plans than without (3,976 instead of 4,246
// for 150 agents on random-32-32-20), but by the time a dual solution exists LNS has found cheaper
// ones (3,830).
#include "primal/primal_search.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "model/assert.h"
#include "model/effort.h"
#include "model/random.h"
#include "primal/lacam_with_restarts.h"
#include "primal/lns.h"
#include "primal/planned_paths.h"
#include "primal/primal_low_level.h"
#include "primal/prioritized_planning.h"
#include "primal/traffic_guided_lacam.h"
#include "primal/visit_orders.h"

namespace grove::detail {
namespace {

// Number of LaCAM steps within which a first plan is expected.
constexpr std::int64_t kLacamExpectedSteps = 4096;
// Rounds of traffic-guided LaCAM without a better plan after which LNS takes over.
constexpr int kGuidedRoundsWithoutGain = 4;
// Traffic-guided LaCAM starts if the plan costs at least this fraction more than the sum of
// individual costs.
constexpr double kMinLossForGuidance = 0.1;
// Effort of the other heuristics per unit of effort of long prioritised planning.
constexpr std::int64_t kOtherWorkPerLatePlanningWork = 8;
constexpr std::int64_t kStallNeighborhoods = 200;  // failed neighbourhoods before a new round
// Failed neighbourhoods per agent before a new round; both numbers must be reached.
constexpr std::int64_t kStallNeighborhoodsPerAgent = 10;
constexpr double kOrderNoise = 0.5;  // noise on the costs by which later rounds sort agents

constexpr std::int64_t kEndless = std::numeric_limits<std::int64_t>::max();
constexpr std::uint64_t kSeeds = std::uint64_t{1} << 32;

}  // namespace

class PrimalSearch::Impl {
 public:
  Impl(const Problem& problem, AgentStopsCache& stops, std::uint64_t seed, Techniques techniques,
       const Tuning& tuning)
      : problem_(problem),
        tuning_(tuning),
        seed_(seed),
        // LaCAM requires following: it lets an agent enter a place in the step in which another
        // leaves it.
        may_step_lacam_(techniques.has(Technique::kLacam) && problem.instance.may_follow()),
        may_guide_(may_step_lacam_),
        agents_(problem.instance.agent_count()),
        random_(seed),
        low_level_(problem, stops),
        paths_(problem.instance),
        planned_(problem.instance),
        planning_(problem.instance.world(), low_level_, planned_, random_, tuning_),
        neighborhoods_(problem, low_level_, paths_, random_, tuning_) {}

  std::optional<Plan> step(const Limits& limits);
  void adopt(const Plan& plan);
  void use(std::shared_ptr<const DualSolution> dual_solution) {
    if (dual_solution && dual_solution.get() != low_level_.dual_solution() &&
        is_near(dual_solution->bound()))
      low_level_.use(std::move(dual_solution));
  }

  PlanSource source() const { return source_; }
  std::optional<Cost> best_cost() const {
    return best_ < kInfiniteCost ? std::optional(best_) : std::nullopt;
  }
  bool expects_plan() const {
    if (!may_step_lacam_ || optimal()) return false;
    if (best_ == kInfiniteCost) return joint_steps_ < kLacamExpectedSteps;
    const std::int64_t factor =
        std::min(tuning_.pp_long_attempt,
                 individual_planning_work_ / tuning_.root_work_per_individual_planning);
    const bool plans = planning_now_ && first_round_;
    return (plans && planning_work_ < factor * individual_planning_work_) ||
           (guided_ && guided_work_ < factor * individual_planning_work_);
  }
  bool optimal() const {
    return individually_planned_ == agents_ && own_costs_are_minimal_ && best_ <= own_costs_;
  }
  std::int64_t work() const {
    return low_level_.work() +
           (paths_.steps_moved() + planned_.steps_moved()) / effort::kMovedSteps +
           joint_steps_ * agents_ + guided_work_;
  }
  std::int64_t work_at_last_plan() const { return work_at_last_plan_; }
  Counts counts() const {
    return {steps_,
            planning_.attempts(),
            joint_steps_ + guided_joint_steps_,
            neighborhoods_.steps(),
            low_level_.calls(),
            low_level_.expanded()};
  }

 private:
  // True if the best plan is within lagrangian_lns_max_gap of `bound`. With a larger gap, a dual
  // solution predicts poorly which places and times are congested.
  bool is_near(ScaledCost bound) const {
    return static_cast<double>(best_) * Penalties::kUnit <=
           (1 + tuning_.lagrangian_lns_max_gap) * static_cast<double>(bound);
  }
  void keep_best();
  bool may_report(const Limits& limits) const;
  void advance(const Limits& limits);
  void plan_individually(const Limits& limits);
  void begin_round(bool first);
  // True if LaCAM or LNS can use part of the effort.
  bool is_raced() const { return improving_ || may_step_lacam_; }
  bool planning_is_due() const;
  void plan(const Limits& limits);
  void take_over_planned();
  void step_lacam(const Limits& limits);
  void begin_guiding(const Plan& plan);
  void guide(const Limits& limits);
  std::vector<Sequence> own_orders() const;
  void put_all(const Plan& plan, PlanSource source);
  void begin_improving();
  void improve(const Limits& limits);
  bool stalled() const;

  const Problem& problem_;
  const Tuning tuning_;
  const std::uint64_t seed_;
  bool may_step_lacam_;
  bool may_guide_;  // traffic-guided LaCAM is possible; at most once per search
  const int agents_;
  Random random_;
  PrimalLowLevel low_level_;
  PlannedPaths paths_;    // the plan that LNS improves, or no paths
  PlannedPaths planned_;  // paths of prioritised planning
  PrioritizedPlanning planning_;
  std::unique_ptr<LacamWithRestarts> lacam_;
  std::unique_ptr<TrafficGuidedLacam> guided_;  // while it finds cheaper plans
  LargeNeighborhoodSearch neighborhoods_;

  AgentIndex individually_planned_ = 0;  // agents from here on have no individual path yet
  Cost own_costs_ = 0;                   // sum over the agents with an individual path
  bool own_costs_are_minimal_ = true;
  std::int64_t individual_planning_work_ = 0;
  std::optional<Plan> adopted_;  // plan adopted before all individual paths were known
  bool improving_ = false;       // there is a plan in paths_
  Cost best_ = kInfiniteCost;
  std::vector<Path> best_paths_;  // by agent: paths of the best plan, if it was found here
  std::vector<std::int64_t> best_versions_;  // by agent: version of its path in best_paths_
  Cost reported_cost_ = kInfiniteCost;       // cost of the best plan returned or adopted
  std::int64_t work_at_last_report_ = 0;
  PlanSource source_ = PlanSource::kPrioritizedPlanning;
  PlanSource source_of_paths_ = PlanSource::kPrioritizedPlanning;
  std::int64_t steps_ = 0;
  std::int64_t joint_steps_ = 0;
  std::int64_t work_at_last_plan_ = 0;
  std::int64_t rounds_without_gain_ = 0;  // rounds of traffic-guided LaCAM without a cheaper plan
  std::int64_t guided_work_ = 0;
  std::int64_t guided_joint_steps_ = 0;
  // State of the current round.
  std::int64_t round_began_ = 0;  // value of work()
  bool first_round_ = true;
  bool planning_now_ = false;  // prioritised planning is in progress
  std::int64_t patience_ = 0;  // label limit of a low-level call while is_raced()
  std::int64_t planning_work_ = 0;
  std::int64_t other_work_ = 0;  // effort of LaCAM and LNS in this round
  Cost round_best_ = kInfiniteCost;
  std::int64_t round_improved_ = 0;       // value of work()
  std::int64_t round_improved_step_ = 0;  // LNS iteration
};

std::optional<Plan> PrimalSearch::Impl::step(const Limits& limits) {
  ++steps_;
  const Cost before = best_;
  if (improving_ && !planning_now_ && stalled()) begin_round(false);
  for (const std::int64_t end = work() + tuning_.primal_step_work; work() < end && !optimal();) {
    if (limits.stop_requested()) break;
    advance(limits);
    if (!improving_ || paths_.cost() >= best_) continue;
    keep_best();
    if (source_ != PlanSource::kLns) break;
  }
  if (best_ < before) work_at_last_plan_ = work();
  if (best_ == reported_cost_ || !may_report(limits)) return std::nullopt;
  reported_cost_ = best_;
  work_at_last_report_ = work();
  return low_level_.plan(best_paths_);
}

void PrimalSearch::Impl::keep_best() {
  best_ = paths_.cost();
  source_ = source_of_paths_;
  best_paths_.resize(static_cast<std::size_t>(agents_));
  best_versions_.resize(best_paths_.size(), 0);
  for (AgentIndex agent = 0; agent < agents_; ++agent) {
    if (best_versions_[agent] == paths_.version(agent)) continue;
    best_versions_[agent] = paths_.version(agent);
    best_paths_[agent] = paths_.path(agent);
  }
}

// Making and checking a plan from its paths takes an effort of about one third of the plan's cost.
// Therefore, when LNS improves a plan in many small steps, only some of the plans are returned.
bool PrimalSearch::Impl::may_report(const Limits& limits) const {
  return source_ != PlanSource::kLns || optimal() || limits.stop_requested() ||
         work() - work_at_last_report_ >= tuning_.lns_report_work * best_;
}

void PrimalSearch::Impl::advance(const Limits& limits) {
  if (individually_planned_ < agents_) return plan_individually(limits);
  const std::int64_t before = work();
  if (planning_is_due()) {
    plan(limits);
    planning_work_ += work() - before;
    return;
  }
  if (!improving_)
    step_lacam(limits);
  else if (guided_)
    guide(limits);
  else
    improve(limits);
  other_work_ += work() - before;
}

void PrimalSearch::Impl::plan_individually(const Limits& limits) {
  const std::int64_t before = work();
  const bool met = low_level_.plan_individually(individually_planned_, limits);
  individual_planning_work_ += work() - before;
  if (!met) return;
  own_costs_are_minimal_ = own_costs_are_minimal_ && low_level_.knows_best(individually_planned_);
  own_costs_ += low_level_.individual_cost(individually_planned_++);
  if (individually_planned_ < agents_) return;
  begin_round(true);
  if (adopted_) put_all(*std::exchange(adopted_, std::nullopt), PlanSource::kStart);
}

void PrimalSearch::Impl::begin_round(bool first) {
  std::vector<std::pair<double, AgentIndex>> keys;
  for (AgentIndex agent = 0; agent < agents_; ++agent) {
    const double spread = first ? 0 : kOrderNoise * (random_.unit() - 0.5);
    keys.emplace_back((1 + spread) * low_level_.individual_cost(agent), agent);
  }
  std::ranges::sort(keys);
  std::vector<AgentIndex> order;
  for (const auto& [key, agent] : keys) order.push_back(agent);
  planning_.begin(std::move(order));
  planning_now_ = true;
  first_round_ = first;
  patience_ = tuning_.pp_head_start * individual_planning_work_;
  planning_work_ = 0;
  other_work_ = 0;
  round_began_ = work();
}

bool PrimalSearch::Impl::planning_is_due() const {
  if (!planning_now_) return false;
  if (!is_raced()) return true;
  const bool ahead = planning_.failures() == 0 &&
                     planning_work_ < tuning_.pp_head_start * individual_planning_work_;
  const bool takes_long =
      improving_ && planning_work_ > tuning_.pp_long_attempt * individual_planning_work_;
  return ahead || planning_work_ <= other_work_ / (takes_long ? kOtherWorkPerLatePlanningWork : 1);
}

void PrimalSearch::Impl::plan(const Limits& limits) {
  using Outcome = PrioritizedPlanning::Outcome;
  const std::int64_t patience = is_raced() ? patience_ : kEndless;
  const Outcome outcome = planning_.step(limits, patience);
  if (outcome == Outcome::kDone) take_over_planned();
  if (outcome == Outcome::kPutOff) patience_ *= 2;
}

void PrimalSearch::Impl::take_over_planned() {
  planning_now_ = false;
  lacam_.reset();
  if (first_round_ && improving_ && planned_.cost() >= paths_.cost()) return planned_.clear();
  guided_.reset();  // plans of prioritised planning are mostly cheaper
  paths_.clear();
  for (AgentIndex agent = 0; agent < agents_; ++agent) paths_.put(agent, planned_.take(agent));
  source_of_paths_ = PlanSource::kPrioritizedPlanning;
  begin_improving();
}

void PrimalSearch::Impl::step_lacam(const Limits& limits) {
  using Outcome = LacamWithRestarts::Outcome;
  if (!lacam_)
    lacam_ = std::make_unique<LacamWithRestarts>(problem_, own_orders(), seed_,
                                                 tuning_.lacam_first_steps);
  const std::int64_t before = lacam_->steps();
  const Outcome outcome =
      lacam_->run(limits, std::max<std::int64_t>(1, tuning_.primal_step_work / agents_));
  joint_steps_ += lacam_->steps() - before;
  if (outcome == Outcome::kFound) {
    put_all(*lacam_->plan(), PlanSource::kLacam);
  }
  // If memory is short, it is left to the rest of the run.
  const bool lost =
      outcome == Outcome::kExhausted || (outcome == Outcome::kStopped && !limits.stop_requested());
  if (lost) may_step_lacam_ = false;
  if (lost || outcome == Outcome::kFound) lacam_.reset();
}

void PrimalSearch::Impl::begin_guiding(const Plan& plan) {
  const double min_cost_to_guide = (1 + kMinLossForGuidance) * static_cast<double>(own_costs_);
  if (!may_guide_ || !may_step_lacam_ || static_cast<double>(plan.cost) < min_cost_to_guide) return;
  may_guide_ = false;
  guided_ = std::make_unique<TrafficGuidedLacam>(problem_, own_orders(),
                                                 static_cast<double>(own_costs_) / agents_,
                                                 random_.below(kSeeds), tuning_);
  guided_->learn(plan);
}

void PrimalSearch::Impl::guide(const Limits& limits) {
  using Outcome = TrafficGuidedLacam::Outcome;
  const Outcome outcome = guided_->run(limits, tuning_.primal_step_work);
  guided_work_ = guided_->work();
  guided_joint_steps_ = guided_->joint_steps();
  if (outcome == Outcome::kWorking || limits.stop_requested()) return;
  ++rounds_without_gain_;
  if (outcome == Outcome::kFound) {
    const Plan& plan = guided_->plan();
    if (plan.cost < paths_.cost()) {
      put_all(plan, PlanSource::kLacam);
      rounds_without_gain_ = 0;
    }
    guided_->learn(plan);
  }
  // If memory is short, it is left to the rest of the run.
  if (outcome == Outcome::kStopped || rounds_without_gain_ >= kGuidedRoundsWithoutGain)
    guided_.reset();
}

// The sequences of the individual paths, with distinct last stops (separate_ends()).
std::vector<Sequence> PrimalSearch::Impl::own_orders() const {
  std::vector<Sequence> orders;
  for (AgentIndex agent = 0; agent < agents_; ++agent)
    orders.push_back(low_level_.individual_order(agent));
  separate_ends(problem_.instance, orders);
  return orders;
}

void PrimalSearch::Impl::begin_improving() {
  improving_ = true;
  neighborhoods_.begin(own_costs_);
  round_best_ = paths_.cost();
  round_improved_ = work();
  round_improved_step_ = neighborhoods_.steps();
}

void PrimalSearch::Impl::improve(const Limits& limits) {
  neighborhoods_.step(limits);
  if (paths_.cost() >= round_best_) return;
  source_of_paths_ = PlanSource::kLns;
  round_best_ = paths_.cost();
  round_improved_ = work();
  round_improved_step_ = neighborhoods_.steps();
}

bool PrimalSearch::Impl::stalled() const {
  const std::int64_t least = std::max(kStallNeighborhoods, kStallNeighborhoodsPerAgent * agents_);
  return neighborhoods_.steps() - round_improved_step_ >= least &&
         work() - round_improved_ >= round_improved_ - round_began_;
}

void PrimalSearch::Impl::adopt(const Plan& plan) {
  if (plan.cost >= best_) return;
  best_ = reported_cost_ = plan.cost;
  if (individually_planned_ < agents_) {
    adopted_ = plan;
    return;
  }
  lacam_.reset();
  if (!planning_now_ || !first_round_) {
    planning_now_ = false;
    round_began_ = work();
  }
  put_all(plan, PlanSource::kStart);
}

void PrimalSearch::Impl::put_all(const Plan& plan, PlanSource source) {
  paths_.clear();
  for (AgentIndex agent = 0; agent < agents_; ++agent) {
    paths_.put(agent, walked_path(problem_.instance, agent, plan.agents[agent]));
  }
  source_of_paths_ = source;
  begin_improving();
  begin_guiding(plan);
}

PrimalSearch::PrimalSearch(const Problem& problem, AgentStopsCache& stops, std::uint64_t seed,
                           Techniques techniques, const Tuning& tuning)
    : impl_(std::make_unique<Impl>(problem, stops, seed, techniques, tuning)) {}
PrimalSearch::~PrimalSearch() = default;

std::optional<Plan> PrimalSearch::step(const Limits& limits) {
  return impl_->step(limits);
}
PlanSource PrimalSearch::source() const {
  return impl_->source();
}
void PrimalSearch::adopt(const Plan& plan) {
  impl_->adopt(plan);
}
void PrimalSearch::use(std::shared_ptr<const DualSolution> dual_solution) {
  impl_->use(std::move(dual_solution));
}
std::optional<Cost> PrimalSearch::best_cost() const {
  return impl_->best_cost();
}
bool PrimalSearch::expects_plan() const {
  return impl_->expects_plan();
}
bool PrimalSearch::optimal() const {
  return impl_->optimal();
}
std::int64_t PrimalSearch::work() const {
  return impl_->work();
}
std::int64_t PrimalSearch::work_at_last_plan() const {
  return impl_->work_at_last_plan();
}
PrimalSearch::Counts PrimalSearch::counts() const {
  return impl_->counts();
}

}  // namespace grove::detail
