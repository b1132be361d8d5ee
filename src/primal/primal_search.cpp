// SPDX-License-Identifier: MIT
// The course of the search: every agent's own best path; prioritised planning until there is a
// plan; large neighbourhood search on it. That works quickly at first and then stalls in a local
// optimum, and other seeds end in other ones. So when a round has gone on without success for as
// long as it took to come where it is, a new round begins with prioritised planning.
//
// The first order is by the agents' own costs, the cheapest first: an agent may not come to rest
// where one before it still passes, so cheap agents planned late would wait for dear ones, while
// these find ways around those that rest. Measured on maps of 64x64 cells and den312d, with 100
// agents and 300 tasks: first plans 0.7-8 % above the sum of own costs; in random order 8-14 %, the
// dearest first 12-18 %. Later rounds sort by costs with some noise.
#include "grove/primal/primal_search.h"

#include <algorithm>
#include <utility>

#include "neighborhood_search.h"
#include "path_set.h"
#include "prioritized_planning.h"
#include "random.h"
#include "router.h"

namespace grove {
namespace {

constexpr std::int64_t kWorkPerStep = 4000;
constexpr std::int64_t kWorkPerCall = 16;
constexpr std::int64_t kStepsMovedPerWork = 8;
constexpr std::int64_t kLeastStall_neighborhoods = 200;
constexpr std::int64_t kLeastStallPerAgent_neighborhoods = 10;
constexpr double kSpread = 0.5;  // of the costs by which later rounds sort, as a part of them

}  // namespace

class PrimalSearch::Impl {
 public:
  Impl(const Problem& problem, AgentStopsStore& stops, std::uint64_t seed)
      : agents_(problem.instance.agent_count()),
        random_(seed),
        router_(problem, stops),
        paths_(problem.instance.grid(), agents_),
        planning_(router_, paths_, random_),
        neighborhoods_(problem, router_, paths_, random_) {}

  std::optional<Plan> step(const Limits& limits);
  void adopt(const Plan& plan);

  PlanSource source() const { return source_; }
  std::optional<Cost> best_cost() const {
    return best_ < kInfiniteCost ? std::optional(best_) : std::nullopt;
  }
  bool optimal() const { return met_ == agents_ && best_ <= own_costs_; }
  std::int64_t work() const {
    return router_.expanded() + kWorkPerCall * router_.calls() +
           paths_.steps_moved() / kStepsMovedPerWork;
  }
  std::int64_t work_at_last_plan() const { return work_at_last_plan_; }
  Counts counts() const {
    return {steps_, planning_.attempts(), neighborhoods_.steps(), router_.calls(),
            router_.expanded()};
  }

 private:
  enum class Phase : std::uint8_t { kMeeting, kPlanning, kImproving };

  void advance(const Limits& limits);
  void meet(const Limits& limits);
  void begin_round(bool first);
  void plan(const Limits& limits);
  void improve_on(const Plan& plan);
  void begin_improving();
  void improve(const Limits& limits);
  bool stalled() const;

  const int agents_;
  Random random_;
  Router router_;
  PathSet paths_;
  PrioritizedPlanning planning_;
  NeighborhoodSearch neighborhoods_;

  Phase phase_ = Phase::kMeeting;
  AgentIndex met_ = 0;           // agents from here on have not been met
  Cost own_costs_ = 0;           // of those met
  std::optional<Plan> adopted_;  // before all agents were met
  Cost best_ = kInfiniteCost;
  PlanSource source_ = PlanSource::kPriorities;
  std::int64_t steps_ = 0;
  std::int64_t work_at_last_plan_ = 0;
  // Of the round under way.
  std::int64_t round_began_ = 0;  // in work
  Cost round_best_ = kInfiniteCost;
  std::int64_t round_improved_ = 0;       // in work
  std::int64_t round_improved_step_ = 0;  // in neighbourhoods
};

std::optional<Plan> PrimalSearch::Impl::step(const Limits& limits) {
  ++steps_;
  const Cost before = best_;
  if (phase_ == Phase::kImproving && stalled()) begin_round(false);
  for (const std::int64_t end = work() + kWorkPerStep; work() < end && !optimal();) {
    if (limits.stop_requested()) break;
    const Phase phase = phase_;
    advance(limits);
    if (phase_ == Phase::kImproving && paths_.cost() < best_) {
      best_ = paths_.cost();
      source_ = phase == Phase::kImproving ? PlanSource::kNeighborhood : PlanSource::kPriorities;
    }
    if (phase_ != phase) break;
  }
  if (best_ == before) return std::nullopt;
  work_at_last_plan_ = work();
  return router_.plan(paths_.paths());
}

void PrimalSearch::Impl::advance(const Limits& limits) {
  switch (phase_) {
    case Phase::kMeeting:
      return meet(limits);
    case Phase::kPlanning:
      return plan(limits);
    case Phase::kImproving:
      return improve(limits);
  }
}

void PrimalSearch::Impl::meet(const Limits& limits) {
  if (met_ < agents_) {
    if (!router_.meet(met_, limits)) return;
    own_costs_ += router_.own_cost(met_++);
  }
  if (met_ < agents_) return;
  if (adopted_)
    improve_on(*std::exchange(adopted_, std::nullopt));
  else
    begin_round(true);
}

void PrimalSearch::Impl::begin_round(bool first) {
  std::vector<std::pair<double, AgentIndex>> keys;
  for (AgentIndex agent = 0; agent < agents_; ++agent) {
    const double spread = first ? 0 : kSpread * (random_.unit() - 0.5);
    keys.emplace_back((1 + spread) * router_.own_cost(agent), agent);
  }
  std::ranges::sort(keys);
  std::vector<AgentIndex> order;
  for (const auto& [key, agent] : keys) order.push_back(agent);
  planning_.begin(std::move(order));
  phase_ = Phase::kPlanning;
  round_began_ = work();
}

void PrimalSearch::Impl::plan(const Limits& limits) {
  if (planning_.step(limits) == PrioritizedPlanning::State::kDone) begin_improving();
}

void PrimalSearch::Impl::begin_improving() {
  phase_ = Phase::kImproving;
  round_best_ = paths_.cost();
  round_improved_ = work();
  round_improved_step_ = neighborhoods_.steps();
}

void PrimalSearch::Impl::improve(const Limits& limits) {
  neighborhoods_.step(limits);
  if (paths_.cost() >= round_best_) return;
  round_best_ = paths_.cost();
  round_improved_ = work();
  round_improved_step_ = neighborhoods_.steps();
}

bool PrimalSearch::Impl::stalled() const {
  const std::int64_t least =
      std::max(kLeastStall_neighborhoods, kLeastStallPerAgent_neighborhoods * agents_);
  return neighborhoods_.steps() - round_improved_step_ >= least &&
         work() - round_improved_ >= round_improved_ - round_began_;
}

void PrimalSearch::Impl::adopt(const Plan& plan) {
  if (plan.cost >= best_) return;
  best_ = plan.cost;
  if (met_ == agents_)
    improve_on(plan);
  else
    adopted_ = plan;
}

void PrimalSearch::Impl::improve_on(const Plan& plan) {
  paths_.clear();
  for (AgentIndex agent = 0; agent < agents_; ++agent) {
    const AgentPlan& part = plan.agents[agent];
    paths_.put(agent, Path(part.path.begin(), part.path.begin() + part.cost + 1));
  }
  round_began_ = work();
  begin_improving();
}

PrimalSearch::PrimalSearch(const Problem& problem, AgentStopsStore& stops, std::uint64_t seed)
    : impl_(std::make_unique<Impl>(problem, stops, seed)) {}
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
std::optional<Cost> PrimalSearch::best_cost() const {
  return impl_->best_cost();
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

}  // namespace grove
