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
// *Helpers*, which are other processes, have copies of the multipliers. A reply identifies its
// multipliers by their digest (multipliers.h). A value is used only if the digest is the current
// one and the agent has no value in this round yet. Therefore, except with probability 2^-64 (equal
// digests of different multipliers), neither delays nor the contents of requests affect the
// validity of the bound. A request contains the cost of a known path as the cutoff of the search,
// so that the value does not exceed that cost. No thread waits for a helper: when all other values
// are available, this process computes the missing ones.
//
// *Step.* See target_level_step.h for the step length. The subgradient of a row is the number of
// its uses by the cheapest paths, minus 1. The direction is a subgradient that is smoothed over
// rounds, because consecutive subgradients tend to cancel each other.
#include "lagrangian/lagrangian_bound.h"

#include <algorithm>
#include <new>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "model/effort.h"

namespace grove::detail {
namespace {

constexpr int kMaxStops = 10;
constexpr std::size_t kMaxMarkBytes = std::size_t{1} << 26;  // of one agent's search
constexpr std::size_t kBytesOfMark = 16;
constexpr std::int64_t kFirstLabels = 2000;               // per agent, assumed before its first job
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
      paths_(static_cast<std::size_t>(instance.agent_count())),
      values_(paths_.size()),
      labels_(paths_.size(), kFirstLabels),
      next_dual_solution_round_(tuning.first_dual_solution_round),
      is_priced_(paths_.size()),
      known_costs_(paths_.size()) {
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
  if (phase_ == Phase::kPricing) job = next_value();
  if (phase_ == Phase::kBetween && in_progress_ == 0) job.emplace();
  if (job) ++in_progress_;
  return job;
}

bool LagrangianBound::has_jobs() const {
  const std::lock_guard lock(mutex_);
  return phase_ == Phase::kPricing ? next_agent_ < end_agent_ || asked_ < taken_over_
                                   : phase_ == Phase::kBetween && in_progress_ == 0;
}

std::optional<LagrangianBound::Job> LagrangianBound::next_value() {
  const std::int64_t most = tuning_.lagrangian_step_work * effort::kPricedLabels;
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
  job.known.assign(known_costs_.begin() + job.first, known_costs_.begin() + job.end);
  return job;
}

void LagrangianBound::perform(Job& job, Pricer& pricer, Cost cutoff, Cost known,
                              const Limits& limits) {
  try {
    do_perform(job, pricer, cutoff, known, limits);
  } catch (const std::bad_alloc&) {
    job.failed = true;
  } catch (const std::overflow_error&) {  // a penalty exceeds its maximum
    job.failed = true;
  }
}

void LagrangianBound::do_perform(Job& job, Pricer& pricer, Cost cutoff, Cost known,
                                 const Limits& limits) {
  if (job.first == job.end) return end_round(job, cutoff, known, limits);
  for (auto agent = job.first + static_cast<AgentIndex>(job.known.size()); agent < job.end; ++agent)
    job.known.push_back(known_value(agent));
  pricer.perform(job, limits);
}

// The penalised cost of the agent's best known path under the current multipliers; kNoCost if no
// path is known.
ScaledCost LagrangianBound::known_value(AgentIndex agent) const {
  return paths_[agent].empty() ? kNoCost : multipliers().price(agent, paths_[agent]);
}

void LagrangianBound::commit(Job job) {
  const std::lock_guard lock(mutex_);
  --in_progress_;
  if (job.failed) phase_ = Phase::kEnded;
  if (phase_ == Phase::kEnded) return;
  if (job.first == job.end) {
    work_between_ += job.work;
    if (new_dual_solution_) dual_solution_ = std::move(new_dual_solution_);
    return;
  }
  for (AgentIndex agent = job.first; agent < job.end; ++agent) {
    const auto at = static_cast<std::size_t>(agent - job.first);
    labels_[agent] = job.work * effort::kPricedLabels / (job.end - job.first);
    store_value(agent, job.values[at], std::move(job.paths[at]));
  }
  end_pricing_if_done();
}

// Stores a value unless the agent already has one, because a helper and a thread of this process
// may both compute it. Returns true if it was stored.
bool LagrangianBound::store_value(AgentIndex agent, ScaledCost price, Path path) {
  if (is_priced_[agent]) return false;
  is_priced_[agent] = 1;
  --unpriced_;
  values_[agent] = price;
  if (!path.empty()) paths_[agent] = std::move(path);
  return true;
}

void LagrangianBound::end_pricing_if_done() {
  if (phase_ != Phase::kPricing || unpriced_ > 0 || in_progress_ > 0) return;
  phase_ = Phase::kBetween;
  ++rounds_;
  work_between_ = 0;
  const ScaledCost bound =
      std::accumulate(values_.begin(), values_.end(), ScaledCost{0}) - multipliers().sum();
  if (bound > best_ && records_best_multipliers_) note_best_multipliers();
  best_ = std::max(best_, bound);
}

void LagrangianBound::note_best_multipliers() {
  best_multipliers_.clear();
  for (Multipliers::RowId id = 0; id < multipliers().count(); ++id)
    if (multipliers().multiplier(id) > 0)
      best_multipliers_.push_back({multipliers().row(id), multipliers().multiplier(id)});
}

// The multipliers do not change during this function: the round cannot end, because the agents of
// the new requests have no values and are not assigned to another job or helper.
std::vector<LagrangianBound::DispatchedRequest> LagrangianBound::dispatch_pricing() {
  const std::vector<AgentRange> cuts = partition_agents();
  std::vector<DispatchedRequest> requests;
  for (const AgentRange& range : cuts) {
    Helper& helper = helpers_[static_cast<std::size_t>(range.helper)];
    PricingRequest request;
    request.round = rounds_;
    request.first = range.first;
    for (AgentIndex agent = range.first; agent < range.end; ++agent)
      request.known.push_back(known_costs_[agent] = known_value(agent));
    request.update = multipliers().update_for(helper.multipliers);
    helper.is_awaiting_reply = true;
    requests.push_back({range.helper, range.work, std::move(request)});
  }
  if (cuts.empty()) return requests;
  const std::lock_guard lock(mutex_);
  asked_ = cuts.back().first;
  return requests;
}

// Balances the expected work between helpers and this process. The share of this process includes
// the work between two rounds, which helpers cannot do. Each helper's share is at least
// lagrangian_min_remote_work, unless agents run out, because a smaller share does not justify a
// message.
std::vector<LagrangianBound::AgentRange> LagrangianBound::partition_agents() {
  const std::lock_guard lock(mutex_);
  std::vector<AgentRange> cuts;
  if (phase_ != Phase::kPricing) return cuts;
  const auto idle = std::ranges::count(helpers_, false, &Helper::is_awaiting_reply);
  const std::int64_t least = tuning_.lagrangian_min_remote_work;
  const std::int64_t left = idle > 0 ? work_left() : 0;
  const std::int64_t requests = std::min<std::int64_t>(idle, left / least - 1);
  if (requests <= 0) return cuts;
  const std::int64_t between = std::exchange(work_between_, 0);
  const std::int64_t part =
      std::max(least, (left + between) / (requests + 1)) * effort::kPricedLabels;
  for (int helper = 0; std::ssize(cuts) < requests && next_agent_ < end_agent_; ++helper) {
    if (helpers_[static_cast<std::size_t>(helper)].is_awaiting_reply) continue;
    const AgentIndex end = end_agent_;
    std::int64_t labels = 0;
    while (labels < part && next_agent_ < end_agent_) labels += labels_[--end_agent_];
    cuts.push_back({helper, end_agent_, end, labels / effort::kPricedLabels});
  }
  return cuts;
}

// The expected work of the agents that are not in a job or request yet, from the numbers of labels
// of their last jobs.
std::int64_t LagrangianBound::work_left() const {
  return std::accumulate(labels_.begin() + next_agent_, labels_.begin() + end_agent_,
                         std::int64_t{0}) /
         effort::kPricedLabels;
}

int LagrangianBound::accept(int helper, PricingReply answer) {
  helpers_.at(static_cast<std::size_t>(helper)).is_awaiting_reply = false;
  const std::lock_guard lock(mutex_);
  if (phase_ != Phase::kPricing || answer.round != rounds_ ||
      answer.digest != multipliers().digest())
    return 0;
  const auto agents = static_cast<AgentIndex>(answer.values.size());
  if (agents == 0 || answer.paths.size() != answer.values.size() || answer.first < asked_ ||
      answer.first > instance_.agent_count() - agents)
    throw std::invalid_argument("pricing result: was not requested");
  int counted = 0;
  for (AgentIndex i = 0; i < agents; ++i) {
    labels_[answer.first + i] = answer.work * effort::kPricedLabels / agents;
    counted += store_value(answer.first + i, answer.values[static_cast<std::size_t>(i)],
                           std::move(answer.paths[static_cast<std::size_t>(i)]));
  }
  end_pricing_if_done();
  return counted;
}

// Performs a part of the computation between two rounds; the next job continues it. It is divided
// into jobs because testing a pair of finish times is expensive.
void LagrangianBound::end_round(Job& job, Cost cutoff, Cost known, const Limits& limits) {
  if (!is_counted_) {
    separate_conflict_rows();
    is_counted_ = true;
    job.work += occupancy_.end() * instance_.agent_count() / effort::kCountedSteps;
  }
  separate_finish_rows(job, limits);
  if (!colliding_.empty()) return;
  move_multipliers(cutoff, known);
  is_counted_ = false;
}

void LagrangianBound::separate_conflict_rows() {
  occupancy_.count(paths_);
  for (const Collision& collision : occupancy_.collisions()) {
    rows_.add(collision);
    const auto [a, b] = std::minmax(collision.a, collision.b);
    const FinishTimePair pair{a, b, static_cast<Time>(paths_[a].size()) - 1,
                              static_cast<Time>(paths_[b].size()) - 1};
    if (!rows_.has(pair)) colliding_.push_back(pair);
  }
}

void LagrangianBound::separate_finish_rows(Job& job, const Limits& limits) {
  const std::int64_t begin = pairs_.work();
  while (!colliding_.empty() && pairs_.work() - begin < tuning_.lagrangian_step_work) {
    const FinishTimePair pair = colliding_.back();
    colliding_.pop_back();
    if (!rows_.has(pair) && pairs_.are_incompatible(pair, limits))
      rows_.add(pairs_.extended(pair, limits));
  }
  job.work += pairs_.work() - begin;
}

// After a dual solution, 1 / kRoundsPerDualSolution of the rounds so far pass before the next one,
// because the bound improves more and more slowly.
void LagrangianBound::store_dual_solution(ScaledCost bound) {
  {
    const std::lock_guard lock(mutex_);
    if (rounds_ < next_dual_solution_round_ || bound < best_) return;
    next_dual_solution_round_ = rounds_ + std::max(1, rounds_ / kRoundsPerDualSolution);
  }
  new_dual_solution_ =
      std::make_shared<const DualSolution>(DualSolution{multipliers(), values_, paths_});
}

void LagrangianBound::move_multipliers(Cost cutoff, Cost known) {
  const ScaledCost bound =
      std::accumulate(values_.begin(), values_.end(), ScaledCost{0}) - multipliers().sum();
  store_dual_solution(bound);
  const double squares = rows_.update_direction(paths_, occupancy_, tuning_.lagrangian_smoothing);
  const double most = static_cast<double>(cutoff) * Penalties::kUnit;
  if (squares > 0) rows_.take_step(ascent_.step(static_cast<double>(bound), most, squares));
  const std::lock_guard lock(mutex_);
  const double hoped = static_cast<double>(best_) + ascent_.level_distance();
  const bool is_futile = rounds_ > tuning_.lagrangian_min_rounds &&
                         hoped < static_cast<double>(known) * Penalties::kUnit;
  const bool is_over = squares <= 0 || ascent_.level_distance() < kMinDistance || is_futile;
  phase_ = is_over ? Phase::kEnded : Phase::kPricing;
  begin_pricing();
}

std::shared_ptr<const DualSolution> LagrangianBound::dual_solution() const {
  const std::lock_guard lock(mutex_);
  return dual_solution_;
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
