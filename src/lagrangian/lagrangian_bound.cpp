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
// Helpers, in other processes, have copies of the multipliers. What they answer names its
// multipliers by their digest (tariff.h) and counts only while that is the digest here, in a round
// that still lacks those prices; so, but for that digest's chance of 2^-64, it does not matter for
// the bound how late an answer is, nor what helpers were told. What a helper has been told of a
// path's price only ends its search earlier, at a price that is not above. Nobody waits for a
// helper: prices that are not there when all others are, are found here.
//
// For how far to go see level_ascent.h; the direction is what the cheapest paths use of each row
// beyond once - a subgradient - smoothed, for one step alone is blind for what the last one did.
#include "lagrangian/lagrangian_bound.h"

#include <algorithm>
#include <new>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace grove::detail {
namespace {

constexpr int kMostStops = 10;
constexpr std::size_t kMostMarkBytes = std::size_t{1} << 26;  // of one agent's search
constexpr std::size_t kBytesOfMark = 16;
constexpr std::int64_t kFirstLabels = 2000;            // of an agent, until it is known better
constexpr std::int64_t kStepsPerWork = 32;             // of paths, counted
constexpr int kRoundsPerList = 4;                      // rounds so far to those until the next list
constexpr double kLeastWay = 0.02 * Penalties::kUnit;  // nothing comes of a shorter one

}  // namespace

std::unique_ptr<LagrangianBound> LagrangianBound::make(const Instance& instance,
                                                       const AgentStopsCache& stops,
                                                       const Tuning& tuning) {
  const auto states = static_cast<std::size_t>(instance.world().state_count());
  for (const Agent& agent : instance.agents()) {
    const std::size_t stops_of_agent = agent.stops.size();
    if (stops_of_agent > kMostStops) return nullptr;
    if ((states << stops_of_agent) * kBytesOfMark > kMostMarkBytes) return nullptr;
  }
  return std::unique_ptr<LagrangianBound>(new LagrangianBound(instance, stops, tuning));
}

LagrangianBound::LagrangianBound(const Instance& instance, const AgentStopsCache& stops,
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
      labels_(paths_.size(), kFirstLabels),
      next_list_(tuning.first_price_list),
      is_priced_(paths_.size()),
      known_(paths_.size()) {
  begin_pricing();
}

void LagrangianBound::begin_pricing() {
  next_agent_ = 0;
  end_agent_ = asked_ = taken_over_ = instance_.agent_count();
  unpriced_ = instance_.agent_count();
  std::ranges::fill(is_priced_, std::uint8_t{0});
}

std::optional<LagrangianBound::Job> LagrangianBound::next() {
  const std::lock_guard lock(mutex_);
  std::optional<Job> job;
  if (phase_ == Phase::kPricing) job = next_price();
  if (phase_ == Phase::kBetween && in_hand_ == 0) job.emplace();
  if (job) ++in_hand_;
  return job;
}

bool LagrangianBound::has_jobs() const {
  const std::lock_guard lock(mutex_);
  return phase_ == Phase::kPricing ? next_agent_ < end_agent_ || asked_ < taken_over_
                                   : phase_ == Phase::kBetween && in_hand_ == 0;
}

std::optional<LagrangianBound::Job> LagrangianBound::next_price() {
  const std::int64_t most = tuning_.lagrangian_step_work * kLabelsPerWork;
  std::int64_t labels = 0;
  Job job;
  job.first = job.end = next_agent_;
  while (job.end < end_agent_ && labels < most) labels += labels_[job.end++];
  next_agent_ = job.end;
  if (job.first < job.end) return job;
  while (taken_over_ > asked_ && is_priced_[taken_over_ - 1]) --taken_over_;
  job.first = job.end = taken_over_;
  while (job.first > asked_ && !is_priced_[job.first - 1] && labels < most)
    labels += labels_[--job.first];
  taken_over_ = job.first;
  if (job.first == job.end) return std::nullopt;
  job.known.assign(known_.begin() + job.first, known_.begin() + job.end);
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
  if (job.first == job.end) return end_round(job, cutoff, known, limits);
  for (auto agent = job.first + static_cast<AgentIndex>(job.known.size()); agent < job.end; ++agent)
    job.known.push_back(known_price(agent));
  pricer.perform(job, limits);
}

// Of the path that it has, under the multipliers of this round.
ScaledCost LagrangianBound::known_price(AgentIndex agent) const {
  return paths_[agent].empty() ? kNoCost : multipliers().price(agent, paths_[agent]);
}

void LagrangianBound::commit(Job job) {
  const std::lock_guard lock(mutex_);
  --in_hand_;
  if (job.failed) phase_ = Phase::kEnded;
  if (phase_ == Phase::kEnded) return;
  if (job.first == job.end) {
    work_between_ += job.work;
    if (new_list_) list_ = std::move(new_list_);
    return;
  }
  for (AgentIndex agent = job.first; agent < job.end; ++agent) {
    const auto at = static_cast<std::size_t>(agent - job.first);
    labels_[agent] = job.work * kLabelsPerWork / (job.end - job.first);
    take_price(agent, job.prices[at], std::move(job.paths[at]));
  }
  end_pricing_if_done();
}

// If it is the first one: of helpers and of those here who did not wait for them.
bool LagrangianBound::take_price(AgentIndex agent, ScaledCost price, Path path) {
  if (is_priced_[agent]) return false;
  is_priced_[agent] = 1;
  --unpriced_;
  prices_[agent] = price;
  if (!path.empty()) paths_[agent] = std::move(path);
  return true;
}

void LagrangianBound::end_pricing_if_done() {
  if (phase_ != Phase::kPricing || unpriced_ > 0 || in_hand_ > 0) return;
  phase_ = Phase::kBetween;
  ++rounds_;
  work_between_ = 0;
  const ScaledCost bound =
      std::accumulate(prices_.begin(), prices_.end(), ScaledCost{0}) - multipliers().sum();
  if (bound > best_ && keeps_reasons_) note_best_multipliers();
  best_ = std::max(best_, bound);
}

void LagrangianBound::note_best_multipliers() {
  reasons_.clear();
  for (Multipliers::RowId id = 0; id < multipliers().count(); ++id)
    if (multipliers().charge(id) > 0)
      reasons_.push_back({multipliers().row(id), multipliers().charge(id)});
}

// The round cannot end meanwhile, for nobody has these agents yet; so the tariff stays as it is.
std::vector<LagrangianBound::Asked> LagrangianBound::dispatch_pricing() {
  const std::vector<AgentRange> cuts = partition_agents();
  std::vector<Asked> shares;
  for (const AgentRange& partition_agents : cuts) {
    Helper& helper = helpers_[static_cast<std::size_t>(partition_agents.helper)];
    PricingRequest share;
    share.round = rounds_;
    share.first = partition_agents.first;
    for (AgentIndex agent = partition_agents.first; agent < partition_agents.end; ++agent)
      share.known.push_back(known_[agent] = known_price(agent));
    share.news = multipliers().update_for(helper.charges);
    helper.owes = true;
    shares.push_back({partition_agents.helper, partition_agents.work, std::move(share)});
  }
  if (cuts.empty()) return shares;
  const std::lock_guard lock(mutex_);
  asked_ = cuts.back().first;
  return shares;
}

// So that all have about as much to do, counting what is done here alone between two rounds; and
// nobody so little that a message is not worth it.
std::vector<LagrangianBound::AgentRange> LagrangianBound::partition_agents() {
  const std::lock_guard lock(mutex_);
  std::vector<AgentRange> cuts;
  if (phase_ != Phase::kPricing) return cuts;
  const auto idle = std::ranges::count(helpers_, false, &Helper::owes);
  const std::int64_t least = tuning_.lagrangian_share_work;
  const std::int64_t left = idle > 0 ? work_left() : 0;
  const std::int64_t shares = std::min<std::int64_t>(idle, left / least - 1);
  if (shares <= 0) return cuts;
  const std::int64_t between = std::exchange(work_between_, 0);
  const std::int64_t part = std::max(least, (left + between) / (shares + 1)) * kLabelsPerWork;
  for (int helper = 0; std::ssize(cuts) < shares && next_agent_ < end_agent_; ++helper) {
    if (helpers_[static_cast<std::size_t>(helper)].owes) continue;
    const AgentIndex end = end_agent_;
    std::int64_t labels = 0;
    while (labels < part && next_agent_ < end_agent_) labels += labels_[--end_agent_];
    cuts.push_back({helper, end_agent_, end, labels / kLabelsPerWork});
  }
  return cuts;
}

// Of the agents that nobody has been asked for, by what they took last.
std::int64_t LagrangianBound::work_left() const {
  return std::accumulate(labels_.begin() + next_agent_, labels_.begin() + end_agent_,
                         std::int64_t{0}) /
         kLabelsPerWork;
}

int LagrangianBound::accept(int helper, PricingReply answer) {
  helpers_.at(static_cast<std::size_t>(helper)).owes = false;
  const std::lock_guard lock(mutex_);
  if (phase_ != Phase::kPricing || answer.round != rounds_ ||
      answer.digest != multipliers().digest())
    return 0;
  const auto agents = static_cast<AgentIndex>(answer.prices.size());
  if (agents == 0 || answer.paths.size() != answer.prices.size() || answer.first < asked_ ||
      answer.first > instance_.agent_count() - agents)
    throw std::invalid_argument("prices that nobody has asked for");
  int counted = 0;
  for (AgentIndex i = 0; i < agents; ++i) {
    labels_[answer.first + i] = answer.work * kLabelsPerWork / agents;
    counted += take_price(answer.first + i, answer.prices[static_cast<std::size_t>(i)],
                          std::move(answer.paths[static_cast<std::size_t>(i)]));
  }
  end_pricing_if_done();
  return counted;
}

// In parts: pairs are dear.
void LagrangianBound::end_round(Job& job, Cost cutoff, Cost known, const Limits& limits) {
  if (!is_counted_) {
    separate_conflict_rows();
    is_counted_ = true;
    job.work += encounters_.end() * instance_.agent_count() / kStepsPerWork;
  }
  separate_finish_rows(job, limits);
  if (!colliding_.empty()) return;
  move_multipliers(cutoff, known);
  is_counted_ = false;
}

void LagrangianBound::separate_conflict_rows() {
  encounters_.count(paths_);
  for (const Collision& collision : encounters_.collisions()) {
    rows_.add(collision);
    const auto [a, b] = std::minmax(collision.a, collision.b);
    const FinishTimeConflict pair{a, b, static_cast<Time>(paths_[a].size()) - 1,
                                  static_cast<Time>(paths_[b].size()) - 1};
    if (!rows_.has(pair)) colliding_.push_back(pair);
  }
}

void LagrangianBound::separate_finish_rows(Job& job, const Limits& limits) {
  const std::int64_t begin = pairs_.work();
  while (!colliding_.empty() && pairs_.work() - begin < tuning_.lagrangian_step_work) {
    const FinishTimeConflict pair = colliding_.back();
    colliding_.pop_back();
    if (!rows_.has(pair) && pairs_.are_incompatible(pair, limits))
      rows_.add(pairs_.extended(pair, limits));
  }
  job.work += pairs_.work() - begin;
}

// Better ones come ever more slowly.
void LagrangianBound::make_list(ScaledCost bound) {
  {
    const std::lock_guard lock(mutex_);
    if (rounds_ < next_list_ || bound < best_) return;
    next_list_ = rounds_ + std::max(1, rounds_ / kRoundsPerList);
  }
  new_list_ = std::make_shared<const DualSolution>(DualSolution{multipliers(), prices_, paths_});
}

void LagrangianBound::move_multipliers(Cost cutoff, Cost known) {
  const ScaledCost bound =
      std::accumulate(prices_.begin(), prices_.end(), ScaledCost{0}) - multipliers().sum();
  make_list(bound);
  const double squares = rows_.turn(paths_, encounters_, tuning_.lagrangian_memory);
  const double most = static_cast<double>(cutoff) * Penalties::kUnit;
  if (squares > 0) rows_.go(ascent_.step(static_cast<double>(bound), most, squares));
  const std::lock_guard lock(mutex_);
  const double hoped = static_cast<double>(best_) + ascent_.way();
  const bool is_futile =
      rounds_ > tuning_.lagrangian_trial && hoped < static_cast<double>(known) * Penalties::kUnit;
  const bool is_over = squares <= 0 || ascent_.way() < kLeastWay || is_futile;
  phase_ = is_over ? Phase::kEnded : Phase::kPricing;
  begin_pricing();
}

std::shared_ptr<const DualSolution> LagrangianBound::price_list() const {
  const std::lock_guard lock(mutex_);
  return list_;
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
