// SPDX-License-Identifier: MIT
// Why the bound holds, for any multipliers y >= 0. Take a plan. Each of its paths costs its agent,
// with the multipliers of the rows that it uses, at least the agent's price; and each row is used
// once at most (relaxed_rows.cpp). Summed over all agents,
//
//   sum of prices <= sum of costs + sum over rows of y * uses <= cost of the plan + sum of y.
//
// So no plan costs less than the sum of prices minus the sum of multipliers. All are integers, of
// which kUnit make a step; the cost of a plan is a whole number of steps, so the bound may be
// rounded up. A price need not be exact, as long as no path costs less (penalized_search.cpp). In
// the sum each price must have been found under one and the same multipliers: they are moved only
// when no job is in hand.
//
// For how far to go see level_ascent.h; the direction is what the cheapest paths use of each row
// beyond once - a subgradient - smoothed, for one step alone is blind for what the last one did.
#include "grove/detail/lagrangian/lagrangian_bound.h"

#include <algorithm>
#include <new>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "grove/detail/lagrangian/least_cost.h"

namespace grove::detail {
namespace {

constexpr int kMostStops = 10;
constexpr std::size_t kMostMarkBytes = std::size_t{1} << 26;  // of one agent's search
constexpr std::size_t kBytesOfMark = 16;
constexpr std::int64_t kLabelsPerWork = 2;   // see search/work.h
constexpr std::int64_t kFirstLabels = 2000;  // of an agent, until it is known better
constexpr std::int64_t kMostLabels = std::int64_t{1} << 23;
constexpr std::int64_t kStepsPerWork = 32;             // of paths, counted
constexpr double kLeastWay = 0.02 * Penalties::kUnit;  // nothing comes of a shorter one

}  // namespace

FreeGoals& Pricer::goals(AgentIndex agent) {
  if (static_cast<std::size_t>(agent) >= goals_.size()) goals_.resize(agent + std::size_t{1});
  if (!goals_[agent])
    goals_[agent] = std::make_unique<FreeGoals>(stops_.of(agent), SequenceClass{});
  return *goals_[agent];
}

std::unique_ptr<LagrangianBound> LagrangianBound::make(const Instance& instance,
                                                       const AgentStopsStore& stops,
                                                       const Tuning& tuning) {
  const auto states = static_cast<std::size_t>(instance.world().state_count());
  for (const Agent& agent : instance.agents()) {
    const std::size_t stops_of_agent = agent.stops.size();
    if (stops_of_agent > kMostStops) return nullptr;
    if ((states << stops_of_agent) * kBytesOfMark > kMostMarkBytes) return nullptr;
  }
  return std::unique_ptr<LagrangianBound>(new LagrangianBound(instance, stops, tuning));
}

LagrangianBound::LagrangianBound(const Instance& instance, const AgentStopsStore& stops,
                                 const Tuning& tuning)
    : instance_(instance),
      tuning_(tuning),
      stops_(stops),
      rows_(instance.world(), instance.agent_count()),
      encounters_(instance.world()),
      pairs_(instance.world(), stops_,
             {.set_nodes = static_cast<std::size_t>(tuning.path_set_nodes),
              .compared_pairs = static_cast<std::size_t>(tuning.compared_pairs),
              .bytes = std::size_t{256} << 20}),
      ascent_(tuning),
      paths_(static_cast<std::size_t>(instance.agent_count())),
      prices_(paths_.size()),
      labels_(paths_.size(), kFirstLabels) {}

std::optional<LagrangianBound::Job> LagrangianBound::next() {
  const std::lock_guard lock(mutex_);
  if (phase_ == Phase::kEnded || (phase_ == Phase::kBetween && in_hand_ > 0)) return std::nullopt;
  Job job;
  if (phase_ == Phase::kPricing) {
    if (next_agent_ == instance_.agent_count()) return std::nullopt;
    job.first = job.end = next_agent_;
    for (std::int64_t labels = 0; job.end < instance_.agent_count() &&
                                  labels < tuning_.lagrangian_step_work * kLabelsPerWork;)
      labels += labels_[job.end++];
    next_agent_ = job.end;
  }
  ++in_hand_;
  return job;
}

void LagrangianBound::perform(Job& job, Pricer& pricer, Cost cutoff, Cost known,
                              const Limits& limits) {
  try {
    do_perform(job, pricer, cutoff, known, limits);
  } catch (const std::bad_alloc&) {
    job.failed = true;
  } catch (const std::overflow_error&) {  // of a penalty
    job.failed = true;
  }
}

void LagrangianBound::do_perform(Job& job, Pricer& pricer, Cost cutoff, Cost known,
                                 const Limits& limits) {
  if (job.first < job.end)
    price(job, pricer, limits);
  else
    end_round(job, cutoff, known, limits);
}

void LagrangianBound::price(Job& job, Pricer& pricer, const Limits& limits) const {
  for (AgentIndex agent = job.first; agent < job.end; ++agent) {
    FreeGoals& goals = pricer.goals(agent);
    const std::int64_t labels = pricer.search().labels();
    Path path;
    job.prices.push_back(paths_[agent].empty()
                             ? first_price(agent, goals, pricer.search(), limits, path)
                             : price_below(rows_.price(agent, paths_[agent]), agent, goals,
                                           pricer.search(), limits, path));
    job.paths.push_back(std::move(path));
    job.work += (pricer.search().labels() - labels) / kLabelsPerWork + 1;
  }
}

// No path is known that would say where to stop, but hardly any costs more than the least.
Price LagrangianBound::first_price(AgentIndex agent, FreeGoals& goals, PenalizedSearch& search,
                                   const Limits& limits, Path& path) const {
  const Price least = Price{least_cost(goals, limits)} * Penalties::kUnit;
  Price price = 0;
  for (Price more = Penalties::kUnit; path.empty(); more *= 4) {
    const Price below = std::min(least + more, PenalizedSearch::kMostPrice);
    price = price_below(below, agent, goals, search, limits, path);
    if (price < below || below == PenalizedSearch::kMostPrice) break;
  }
  return price;
}

Price LagrangianBound::price_below(Price below, AgentIndex agent, FreeGoals& goals,
                                   PenalizedSearch& search, const Limits& limits,
                                   Path& path) const {
  Completions& completions = goals.completions();
  if (Price{completions.beyond()} * Penalties::kUnit < below)
    completions.widen(static_cast<Time>(below / Penalties::kUnit), limits);
  return search.search(goals, rows_.on_finish(agent), below, kMostLabels, limits, &path);
}

void LagrangianBound::commit(Job job) {
  const std::lock_guard lock(mutex_);
  --in_hand_;
  if (job.failed) phase_ = Phase::kEnded;
  if (phase_ == Phase::kEnded) return;
  for (AgentIndex agent = job.first; agent < job.end; ++agent) {
    const auto at = static_cast<std::size_t>(agent - job.first);
    prices_[agent] = job.prices[at];
    labels_[agent] = job.work * kLabelsPerWork / (job.end - job.first);
    if (!job.paths[at].empty()) paths_[agent] = std::move(job.paths[at]);
  }
  if (phase_ == Phase::kPricing && next_agent_ == instance_.agent_count() && in_hand_ == 0) {
    phase_ = Phase::kBetween;
    ++rounds_;
    const Price bound =
        std::accumulate(prices_.begin(), prices_.end(), Price{0}) - rows_.sum_of_multipliers();
    best_ = std::max(best_, bound);
  }
}

// In parts: pairs are dear.
void LagrangianBound::end_round(Job& job, Cost cutoff, Cost known, const Limits& limits) {
  if (!is_counted_) {
    look_at_collisions();
    is_counted_ = true;
    job.work += encounters_.end() * instance_.agent_count() / kStepsPerWork;
  }
  look_at_pairs(job, limits);
  if (!colliding_.empty()) return;
  move_multipliers(cutoff, known);
  is_counted_ = false;
}

void LagrangianBound::look_at_collisions() {
  encounters_.count(paths_);
  for (const Collision& collision : encounters_.collisions()) {
    rows_.add(collision);
    const auto [a, b] = std::minmax(collision.a, collision.b);
    const FinishPair pair{a, b, static_cast<Time>(paths_[a].size()) - 1,
                          static_cast<Time>(paths_[b].size()) - 1};
    if (!rows_.has(pair)) colliding_.push_back(pair);
  }
}

void LagrangianBound::look_at_pairs(Job& job, const Limits& limits) {
  const std::int64_t begin = pairs_.work();
  while (!colliding_.empty() && pairs_.work() - begin < tuning_.lagrangian_step_work) {
    const FinishPair pair = colliding_.back();
    colliding_.pop_back();
    if (!rows_.has(pair) && pairs_.exclude_each_other(pair, limits))
      rows_.add(pairs_.extended(pair, limits));
  }
  job.work += pairs_.work() - begin;
}

void LagrangianBound::move_multipliers(Cost cutoff, Cost known) {
  const Price bound =
      std::accumulate(prices_.begin(), prices_.end(), Price{0}) - rows_.sum_of_multipliers();
  const double squares = rows_.turn(paths_, encounters_, tuning_.lagrangian_memory);
  const double most = static_cast<double>(cutoff) * Penalties::kUnit;
  if (squares > 0) rows_.go(ascent_.step(static_cast<double>(bound), most, squares));
  const std::lock_guard lock(mutex_);
  const double hoped = static_cast<double>(best_) + ascent_.way();
  const bool is_futile =
      rounds_ > tuning_.lagrangian_trial && hoped < static_cast<double>(known) * Penalties::kUnit;
  const bool is_over = squares <= 0 || ascent_.way() < kLeastWay || is_futile;
  phase_ = is_over ? Phase::kEnded : Phase::kPricing;
  next_agent_ = 0;
}

bool LagrangianBound::ended() const {
  const std::lock_guard lock(mutex_);
  return phase_ == Phase::kEnded;
}

Cost LagrangianBound::lower_bound() const {
  const std::lock_guard lock(mutex_);
  return static_cast<Cost>((best_ + Penalties::kUnit - 1) / Penalties::kUnit);
}

int LagrangianBound::rounds() const {
  const std::lock_guard lock(mutex_);
  return rounds_;
}

}  // namespace grove::detail
