// SPDX-License-Identifier: MIT
// The course of the search: every agent's own best path; a first plan; large neighbourhood search
// on it. That works quickly at first and then stalls in a local optimum, and other seeds end in
// other ones. So when a round has gone on without success for as long as it took to come where it
// is, a new round begins with prioritised planning.
//
// Prices of the Lagrangian bound, once there are some, help with neighbourhoods alone: a plan by
// prioritised planning with penalties, or from the paths of these prices, is cheaper than one
// without (3,976 instead of 4,246 for 150 agents on random-32-32-20), but dearer than what the
// neighbourhoods have made by then (3,830).
//
// Prioritised planning is given a head start: one attempt, of at most so many times the work that
// meeting the agents took. It ends within 1.5 times that where there is room, with plans much
// cheaper than the configuration search's (1.1 to 3.5 times the sum of own costs). When the head
// start is used up, it shares the work equally with the configuration search, until one of them has
// a plan; a single call that takes long is put off, to be made with twice the patience: one that
// proves that an agent is shut in can take longer than the tree needs for a small instance.
// If the configuration search is first (mostly within twice the meeting's work), large
// neighbourhood search takes its plan and its half of the work. Prioritised planning keeps the
// other: where it has a plan in the end, that is mostly the cheaper one by far (room-64-64-8, 100
// agents, 300 tasks: 28,118 after a work of 330,000; the configuration search 30,979 after 40,000,
// which large neighbourhood search had brought down to 30,964 by then), and taken if so. A plan of
// another search, which comes meanwhile, ends that as little as one of its own. In later rounds it
// shares with the large neighbourhood search of the round before in the same way, so no round waits
// for a plan that never comes.
//
// Where it is so crowded that the configuration search's plan costs much more than the agents
// alone, guided search (guided_search.cpp) goes on from it, round by round, as long as that makes
// cheaper plans. Large neighbourhood search, which changes too little at a time to empty a jam,
// follows: warehouse-10-20-10-2-1 with 900 agents goes from 206,729 to 115,468 in six seconds,
// where it alone came from 204,322 to 197,747 in four. Prioritised planning mostly fails there:
// after long_planning meetings it gets the ninth part of the work.
//
// The tree waits for that cheaper plan, but no longer than its root takes: that looks at all pairs
// of agents, so it is taken to be as many meetings as go into the meeting's work by
// meeting_of_root_work, long_planning at most.
//
// The first order is by the agents' own costs, the cheapest first: an agent may not come to rest
// where one before it still passes, so cheap agents planned late would wait for dear ones, while
// these find ways around those that rest. Measured on maps of 64x64 cells and den312d, with 100
// agents and 300 tasks: first plans 0.7-8 % above the sum of own costs; in random order 8-14 %, the
// dearest first 12-18 %. (Those who must visit another's destination before it: 0.5 instead of
// 0.2 % with 500 agents and 3,000 tasks in a warehouse.) Later rounds sort by costs with some
// noise.
#include "primal/primal_search.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "model/assert.h"
#include "model/random.h"
#include "primal/lacam_with_restarts.h"
#include "primal/lns.h"
#include "primal/planned_paths.h"
#include "primal/primal_low_level.h"
#include "primal/prioritized_planning.h"
#include "primal/traffic_guided_lacam.h"
#include "primal/visit_orders.h"
#include "search/work.h"

namespace grove::detail {
namespace {

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
        // (Its agents move into each other's places.)
        may_configure_(techniques.has(Technique::kConfigurations) && problem.instance.may_follow()),
        may_guide_(may_configure_),
        agents_(problem.instance.agent_count()),
        random_(seed),
        router_(problem, stops),
        paths_(problem.instance),
        planned_(problem.instance),
        planning_(problem.instance.world(), router_, planned_, random_, tuning_),
        neighborhoods_(problem, router_, paths_, random_, tuning_) {}

  std::optional<Plan> step(const Limits& limits);
  void adopt(const Plan& plan);
  void use(std::shared_ptr<const DualSolution> prices) {
    if (prices && prices.get() != router_.prices() && is_near(prices->bound()))
      router_.use(std::move(prices));
  }

  PlanSource source() const { return source_; }
  std::optional<Cost> best_cost() const {
    return best_ < kInfiniteCost ? std::optional(best_) : std::nullopt;
  }
  bool expects_plan() const {
    if (!may_configure_ || optimal()) return false;
    if (best_ == kInfiniteCost) return joint_steps_ < tuning_.joint_steps_to_plan;
    const std::int64_t meetings =
        std::min(tuning_.long_planning, meeting_work_ / tuning_.meeting_of_root_work);
    const bool plans = planning_now_ && first_round_;
    return (plans && planning_work_ < meetings * meeting_work_) ||
           (guided_ && guided_work_ < meetings * meeting_work_);
  }
  bool optimal() const { return met_ == agents_ && own_costs_are_least_ && best_ <= own_costs_; }
  std::int64_t work() const {
    return router_.work() + (paths_.steps_moved() + planned_.steps_moved()) / work::kStepsMoved +
           joint_steps_ * agents_ + guided_work_;
  }
  std::int64_t work_at_last_plan() const { return work_at_last_plan_; }
  Counts counts() const {
    return {steps_,
            planning_.attempts(),
            joint_steps_ + guided_joint_steps_,
            neighborhoods_.steps(),
            router_.calls(),
            router_.expanded()};
  }

 private:
  // Far from what is proven, prices say little about what will be dear.
  bool is_near(ScaledCost bound) const {
    return static_cast<double>(best_) * Penalties::kUnit <=
           (1 + tuning_.priced_gap) * static_cast<double>(bound);
  }
  void keep_best();
  bool may_tell(const Limits& limits) const;
  void advance(const Limits& limits);
  void meet(const Limits& limits);
  void begin_round(bool first);
  // Is there other work than prioritised planning?
  bool is_raced() const { return improving_ || may_configure_; }
  bool planning_is_due() const;
  void plan(const Limits& limits);
  void take_over_planned();
  void configure(const Limits& limits);
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
  bool may_configure_;
  bool may_guide_;  // once
  const int agents_;
  Random random_;
  PrimalLowLevel router_;
  PlannedPaths paths_;    // the plan that is being improved, or none
  PlannedPaths planned_;  // by prioritised planning
  PrioritizedPlanning planning_;
  std::unique_ptr<LacamWithRestarts> configurations_;
  std::unique_ptr<TrafficGuidedLacam> guided_;  // while it makes cheaper plans
  LargeNeighborhoodSearch neighborhoods_;

  AgentIndex met_ = 0;  // agents from here on have not been met
  Cost own_costs_ = 0;  // of those met
  bool own_costs_are_least_ = true;
  std::int64_t meeting_work_ = 0;
  std::optional<Plan> adopted_;  // before all agents were met
  bool improving_ = false;       // there is a plan in paths_
  Cost best_ = kInfiniteCost;
  std::vector<Path> best_paths_;             // of that, if it was found here; by agent
  std::vector<std::int64_t> best_editions_;  // by agent: of paths_
  Cost told_ = kInfiniteCost;                // the best one that was returned, or adopted
  std::int64_t work_when_told_ = 0;
  PlanSource source_ = PlanSource::kPrioritizedPlanning;
  PlanSource source_of_paths_ = PlanSource::kPrioritizedPlanning;
  std::int64_t steps_ = 0;
  std::int64_t joint_steps_ = 0;
  std::int64_t work_at_last_plan_ = 0;
  std::int64_t rounds_in_vain_ = 0;  // of guided search
  std::int64_t guided_work_ = 0;
  std::int64_t guided_joint_steps_ = 0;
  // Of the round under way.
  std::int64_t round_began_ = 0;  // in work
  bool first_round_ = true;
  bool planning_now_ = false;  // prioritised planning is under way
  std::int64_t patience_ = 0;  // with a call of prioritised planning, while it is raced
  std::int64_t planning_work_ = 0;
  std::int64_t other_work_ = 0;  // since it began
  Cost round_best_ = kInfiniteCost;
  std::int64_t round_improved_ = 0;       // in work
  std::int64_t round_improved_step_ = 0;  // in neighbourhoods
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
  if (best_ == told_ || !may_tell(limits)) return std::nullopt;
  told_ = best_;
  work_when_told_ = work();
  return router_.plan(best_paths_);
}

void PrimalSearch::Impl::keep_best() {
  best_ = paths_.cost();
  source_ = source_of_paths_;
  best_paths_.resize(static_cast<std::size_t>(agents_));
  best_editions_.resize(best_paths_.size(), 0);
  for (AgentIndex agent = 0; agent < agents_; ++agent) {
    if (best_editions_[agent] == paths_.edition(agent)) continue;
    best_editions_[agent] = paths_.edition(agent);
    best_paths_[agent] = paths_.path(agent);
  }
}

// To make a plan of paths and to check it takes about as long as a third of its cost in work: where
// many agents improve by small steps it is told now and then.
bool PrimalSearch::Impl::may_tell(const Limits& limits) const {
  return source_ != PlanSource::kLns || optimal() || limits.stop_requested() ||
         work() - work_when_told_ >= tuning_.work_to_tell * best_;
}

void PrimalSearch::Impl::advance(const Limits& limits) {
  if (met_ < agents_) return meet(limits);
  const std::int64_t before = work();
  if (planning_is_due()) {
    plan(limits);
    planning_work_ += work() - before;
    return;
  }
  if (!improving_)
    configure(limits);
  else if (guided_)
    guide(limits);
  else
    improve(limits);
  other_work_ += work() - before;
}

void PrimalSearch::Impl::meet(const Limits& limits) {
  const std::int64_t before = work();
  const bool met = router_.meet(met_, limits);
  meeting_work_ += work() - before;
  if (!met) return;
  own_costs_are_least_ = own_costs_are_least_ && router_.knows_best(met_);
  own_costs_ += router_.individual_cost(met_++);
  if (met_ < agents_) return;
  begin_round(true);
  if (adopted_) put_all(*std::exchange(adopted_, std::nullopt), PlanSource::kStart);
}

void PrimalSearch::Impl::begin_round(bool first) {
  std::vector<std::pair<double, AgentIndex>> keys;
  for (AgentIndex agent = 0; agent < agents_; ++agent) {
    const double spread = first ? 0 : tuning_.order_spread * (random_.unit() - 0.5);
    keys.emplace_back((1 + spread) * router_.individual_cost(agent), agent);
  }
  std::ranges::sort(keys);
  std::vector<AgentIndex> order;
  for (const auto& [key, agent] : keys) order.push_back(agent);
  planning_.begin(std::move(order));
  planning_now_ = true;
  first_round_ = first;
  patience_ = tuning_.planning_head_start * meeting_work_;
  planning_work_ = 0;
  other_work_ = 0;
  round_began_ = work();
}

bool PrimalSearch::Impl::planning_is_due() const {
  if (!planning_now_) return false;
  if (!is_raced()) return true;
  const bool ahead =
      planning_.failures() == 0 && planning_work_ < tuning_.planning_head_start * meeting_work_;
  const bool takes_long = improving_ && planning_work_ > tuning_.long_planning * meeting_work_;
  return ahead || planning_work_ <= other_work_ / (takes_long ? tuning_.others_to_planning : 1);
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
  configurations_.reset();
  if (first_round_ && improving_ && planned_.cost() >= paths_.cost()) return planned_.clear();
  guided_.reset();  // such plans are the cheaper ones
  paths_.clear();
  for (AgentIndex agent = 0; agent < agents_; ++agent) paths_.put(agent, planned_.take(agent));
  source_of_paths_ = PlanSource::kPrioritizedPlanning;
  begin_improving();
}

void PrimalSearch::Impl::configure(const Limits& limits) {
  using Outcome = LacamWithRestarts::Outcome;
  if (!configurations_)
    configurations_ = std::make_unique<LacamWithRestarts>(problem_, own_orders(), seed_,
                                                          tuning_.first_joint_steps);
  const std::int64_t before = configurations_->steps();
  const Outcome outcome =
      configurations_->run(limits, std::max<std::int64_t>(1, tuning_.primal_step_work / agents_));
  joint_steps_ += configurations_->steps() - before;
  if (outcome == Outcome::kFound) {
    put_all(*configurations_->plan(), PlanSource::kConfigurations);
  }
  // Where memory is short it is left to others.
  const bool lost =
      outcome == Outcome::kExhausted || (outcome == Outcome::kStopped && !limits.stop_requested());
  if (lost) may_configure_ = false;
  if (lost || outcome == Outcome::kFound) configurations_.reset();
}

void PrimalSearch::Impl::begin_guiding(const Plan& plan) {
  const double crowded = (1 + tuning_.guided_loss) * static_cast<double>(own_costs_);
  if (!may_guide_ || !may_configure_ || static_cast<double>(plan.cost) < crowded) return;
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
  ++rounds_in_vain_;
  if (outcome == Outcome::kFound) {
    const Plan& plan = guided_->plan();
    if (plan.cost < paths_.cost()) {
      put_all(plan, PlanSource::kConfigurations);
      rounds_in_vain_ = 0;
    }
    guided_->learn(plan);
  }
  // Where memory is short it is left to others.
  if (outcome == Outcome::kStopped || rounds_in_vain_ >= tuning_.guided_rounds) guided_.reset();
}

// The cheapest orders, as meeting the agents has found them.
std::vector<Sequence> PrimalSearch::Impl::own_orders() const {
  std::vector<Sequence> orders;
  for (AgentIndex agent = 0; agent < agents_; ++agent)
    orders.push_back(router_.individual_order(agent));
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
  const std::int64_t least =
      std::max(tuning_.stall_neighborhoods, tuning_.stall_neighborhoods_per_agent * agents_);
  return neighborhoods_.steps() - round_improved_step_ >= least &&
         work() - round_improved_ >= round_improved_ - round_began_;
}

void PrimalSearch::Impl::adopt(const Plan& plan) {
  if (plan.cost >= best_) return;
  best_ = told_ = plan.cost;
  if (met_ < agents_) {
    adopted_ = plan;
    return;
  }
  configurations_.reset();
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
void PrimalSearch::use(std::shared_ptr<const DualSolution> prices) {
  impl_->use(std::move(prices));
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
