// SPDX-License-Identifier: MIT
// *Claim: all values of a reply were computed under the multipliers that its digest identifies.*
// *Proof.* Only accept() changes the multipliers, and it computes the digest afterwards. It rejects
// a new request until the reply to the previous one was taken, which requires that all jobs of that
// request are committed. Therefore the multipliers do not change while a job is in progress.
#include "lagrangian/remote_pricing.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace grove::detail {

RemotePricing::RemotePricing(const Instance& instance)
    : instance_(instance), multipliers_(instance.world(), instance.agent_count()) {}

void RemotePricing::accept(PricingRequest request) {
  const std::lock_guard lock(mutex_);
  const auto agents = static_cast<std::int64_t>(request.known.size());
  if (request_ || agents == 0 || request.first < 0 ||
      request.first + agents > instance_.agent_count())
    throw std::invalid_argument("pricing request: invalid agents");
  multipliers_.apply(request.update);
  answer_.round = request.round;
  answer_.digest = multipliers_.digest();
  answer_.first = request.first;
  answer_.values.assign(request.known.size(), 0);
  answer_.paths.assign(request.known.size(), {});
  answer_.work = 0;
  next_ = done_ = 0;
  request_ = std::move(request);
}

std::optional<PricingJob> RemotePricing::next() {
  const std::lock_guard lock(mutex_);
  if (!request_ || next_ == request_->known.size()) return std::nullopt;
  PricingJob job;
  job.first = request_->first + static_cast<AgentIndex>(next_);
  job.end = job.first + 1;
  job.known = {request_->known[next_++]};
  return job;
}

bool RemotePricing::has_jobs() const {
  const std::lock_guard lock(mutex_);
  return request_ && next_ < request_->known.size();
}

void RemotePricing::commit(PricingJob job) {
  const std::lock_guard lock(mutex_);
  const auto at = static_cast<std::size_t>(job.first - answer_.first);
  std::ranges::copy(job.values, answer_.values.begin() + static_cast<std::ptrdiff_t>(at));
  std::ranges::move(job.paths, answer_.paths.begin() + static_cast<std::ptrdiff_t>(at));
  answer_.work += job.work;
  done_ += job.values.size();
}

std::optional<PricingReply> RemotePricing::take_answer() {
  const std::lock_guard lock(mutex_);
  if (!request_ || done_ < request_->known.size()) return std::nullopt;
  request_.reset();
  return std::exchange(answer_, {});
}

}  // namespace grove::detail
