// SPDX-License-Identifier: MIT
// *Claim: all values of a round are computed under the same multipliers*, as lagrangian_bound.cpp
// requires. *Proof.* An update job is given out only while no other job is in progress, and values
// are stored only in the round of their job.
#include "lagrangian/pricing_queue.h"

#include <algorithm>
#include <new>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "model/assert.h"
#include "model/effort.h"

namespace grove::detail {
namespace {

constexpr std::int64_t kFirstLabels = 2000;  // per agent, assumed before its first job

}  // namespace

PricingQueue::PricingQueue(std::unique_ptr<LagrangianBound> bound, const Tuning& tuning)
    : tuning_(tuning),
      bound_(std::move(bound)),
      labels_(static_cast<std::size_t>(bound_->agent_count()), kFirstLabels),
      known_costs_(labels_.size()) {
  begin_pricing();
}

void PricingQueue::begin_pricing() {
  next_agent_ = 0;
  end_agent_ = requested_ = taken_over_ = bound_->agent_count();
}

std::optional<PricingQueue::Job> PricingQueue::next() {
  const std::lock_guard lock(mutex_);
  if (bound_->ended()) return std::nullopt;
  Job job;
  if (bound_->is_pricing()) {
    job = next_values();
    if (job.first == job.end) return std::nullopt;
  } else if (in_progress_ > 0) {
    return std::nullopt;
  }
  ++in_progress_;
  return job;
}

bool PricingQueue::has_jobs() const {
  const std::lock_guard lock(mutex_);
  if (bound_->ended()) return false;
  return bound_->is_pricing() ? next_agent_ < end_agent_ || requested_ < taken_over_
                              : in_progress_ == 0;
}

// Returns a job without agents if all agents have values or jobs.
PricingQueue::Job PricingQueue::next_values() {
  const std::int64_t most = tuning_.lagrangian_step_work * effort::kPricedLabels;
  std::int64_t labels = 0;
  Job job;
  job.first = job.end = next_agent_;
  while (job.end < end_agent_ && labels < most) labels += labels_[job.end++];
  next_agent_ = job.end;
  if (job.first < job.end) return job;
  while (taken_over_ > requested_ && bound_->has_value(taken_over_ - 1)) --taken_over_;
  job.first = job.end = taken_over_;
  while (job.first > requested_ && !bound_->has_value(job.first - 1) && labels < most)
    labels += labels_[--job.first];
  taken_over_ = job.first;
  job.known.assign(known_costs_.begin() + job.first, known_costs_.begin() + job.end);
  return job;
}

void PricingQueue::perform(Job& job, Pricer& pricer, Cost cutoff, Cost known,
                           const Limits& limits) {
  try {
    if (job.first == job.end) return update(job, cutoff, known, limits);
    for (auto agent = job.first + static_cast<AgentIndex>(job.known.size()); agent < job.end;
         ++agent)
      job.known.push_back(bound_->known_value(agent));
    pricer.perform(job, limits);
  } catch (const std::bad_alloc&) {
    job.failed = true;
  } catch (const std::overflow_error&) {  // a penalty exceeds its maximum
    job.failed = true;
  }
}

void PricingQueue::update(Job& job, Cost cutoff, Cost known, const Limits& limits) {
  if (!bound_->update(cutoff, limits, job.work)) return;
  const std::lock_guard lock(mutex_);
  bound_->begin_round(known);
  begin_pricing();
}

void PricingQueue::commit(Job job) {
  const std::lock_guard lock(mutex_);
  --in_progress_;
  GROVE_CHECK(in_progress_ >= 0, "each job is committed once");
  if (job.failed) bound_->end();
  if (bound_->ended()) return;
  if (job.first == job.end) {
    work_between_ += job.work;
    dual_solution_ = bound_->dual_solution();
    end_pricing_if_done();  // other threads may have priced all agents by now
    return;
  }
  for (AgentIndex agent = job.first; agent < job.end; ++agent) {
    const auto at = static_cast<std::size_t>(agent - job.first);
    labels_[agent] = job.work * effort::kPricedLabels / (job.end - job.first);
    bound_->store_value(agent, job.values[at], std::move(job.paths[at]));
  }
  end_pricing_if_done();
}

void PricingQueue::end_pricing_if_done() {
  if (!bound_->is_pricing() || bound_->missing_values() > 0 || in_progress_ > 0) return;
  GROVE_CHECK(next_agent_ == end_agent_, "each agent has had a job or is reserved");
  bound_->end_pricing();
  work_between_ = 0;
}

// Balances the expected work between other processes and this one. The share of this process
// includes the work between two rounds, which others cannot do. A share below
// lagrangian_min_remote_work does not justify a message. Only the last share can be smaller, if no
// agents are left.
std::vector<PricingQueue::Range> PricingQueue::reserve(std::int64_t processes) {
  const std::lock_guard lock(mutex_);
  std::vector<Range> ranges;
  if (!bound_->is_pricing() || processes == 0) return ranges;
  const std::int64_t least = tuning_.lagrangian_min_remote_work;
  const std::int64_t left = work_left();
  const std::int64_t requests = std::min<std::int64_t>(processes, left / least - 1);
  if (requests <= 0) return ranges;
  const std::int64_t between = std::exchange(work_between_, 0);
  const std::int64_t part =
      std::max(least, (left + between) / (requests + 1)) * effort::kPricedLabels;
  while (std::ssize(ranges) < requests && next_agent_ < end_agent_) {
    const AgentIndex end = end_agent_;
    std::int64_t labels = 0;
    while (labels < part && next_agent_ < end_agent_) labels += labels_[--end_agent_];
    ranges.push_back({end_agent_, end, labels / effort::kPricedLabels});
  }
  return ranges;
}

// The expected work of the agents that are neither in a job nor reserved, from the numbers of
// labels of their last jobs.
std::int64_t PricingQueue::work_left() const {
  return std::accumulate(labels_.begin() + next_agent_, labels_.begin() + end_agent_,
                         std::int64_t{0}) /
         effort::kPricedLabels;
}

// The multipliers do not change during this function: the round cannot end, because the agents of
// the range have no values and no jobs.
PricingRequest PricingQueue::request_for(const Range& range) {
  PricingRequest request;
  request.round = bound_->rounds();
  request.first = range.first;
  for (AgentIndex agent = range.first; agent < range.end; ++agent)
    request.known.push_back(known_costs_[agent] = bound_->known_value(agent));
  return request;
}

void PricingQueue::requested(const std::vector<Range>& ranges) {
  if (ranges.empty()) return;
  const std::lock_guard lock(mutex_);
  GROVE_CHECK(ranges.back().first >= end_agent_ && ranges.back().first <= requested_,
              "requests are for reserved agents");
  requested_ = ranges.back().first;
}

int PricingQueue::accept(PricingReply reply) {
  const std::lock_guard lock(mutex_);
  if (!bound_->is_pricing() || reply.round != bound_->rounds() ||
      reply.digest != multipliers().digest())
    return 0;
  const auto agents = static_cast<AgentIndex>(reply.values.size());
  if (agents == 0 || reply.paths.size() != reply.values.size() || reply.first < requested_ ||
      reply.first > bound_->agent_count() - agents)
    throw std::invalid_argument("pricing result: contains agents that were not requested");
  int stored = 0;
  for (AgentIndex i = 0; i < agents; ++i) {
    labels_[reply.first + i] = reply.work * effort::kPricedLabels / agents;
    stored += bound_->store_value(reply.first + i, reply.values[static_cast<std::size_t>(i)],
                                  std::move(reply.paths[static_cast<std::size_t>(i)]));
  }
  end_pricing_if_done();
  return stored;
}

std::shared_ptr<const DualSolution> PricingQueue::dual_solution() const {
  const std::lock_guard lock(mutex_);
  return dual_solution_;
}

bool PricingQueue::ended() const {
  const std::lock_guard lock(mutex_);
  return bound_->ended();
}

Cost PricingQueue::lower_bound() const {
  const std::lock_guard lock(mutex_);
  return bound_->lower_bound();
}

int PricingQueue::rounds() const {
  const std::lock_guard lock(mutex_);
  return bound_->rounds();
}

}  // namespace grove::detail
