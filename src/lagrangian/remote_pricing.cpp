// SPDX-License-Identifier: MIT
// *Claim: every value that the owner stores was computed under the owner's current multipliers,
// except with probability 2^-64* (equal digests of different multipliers). Therefore neither delays
// nor the contents of requests affect the validity of the bound (lagrangian_bound.cpp). *Proof.*
// The owner uses a reply only if its digest (multipliers.h) is that of the current multipliers, the
// round is the current one, and the agent has no value in this round. It remains to show that all
// values of a reply were computed under the multipliers that its digest identifies. Only
// PricingHelper::accept() changes the helper's multipliers, and it computes the digest afterwards.
// It rejects a new request until the reply to the previous one was taken, which requires that all
// jobs of that request are committed. Therefore the multipliers do not change while a job is in
// progress.
//
// A request contains the cost of a known path as the cutoff of the search, so that the value does
// not exceed that cost.
#include "lagrangian/remote_pricing.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "model/assert.h"

namespace grove::detail {

std::vector<PricingDispatcher::Dispatch> PricingDispatcher::dispatch(PricingQueue& queue) {
  const auto ranges =
      queue.reserve(std::ranges::count(helpers_, false, &Helper::is_awaiting_reply));
  std::vector<Dispatch> dispatches;
  auto helper = helpers_.begin();
  for (const PricingQueue::Range& range : ranges) {
    helper =
        std::find_if(helper, helpers_.end(), [](const Helper& h) { return !h.is_awaiting_reply; });
    GROVE_CHECK(helper != helpers_.end(),
                "at most one range is reserved per helper without a request");
    PricingRequest request = queue.request_for(range);
    request.update = queue.multipliers().update_for(helper->multipliers);
    helper->is_awaiting_reply = true;
    dispatches.push_back(
        {static_cast<int>(helper - helpers_.begin()), range.work, std::move(request)});
  }
  queue.requested(ranges);
  return dispatches;
}

int PricingDispatcher::accept(int helper, PricingReply reply, PricingQueue& queue) {
  helpers_.at(static_cast<std::size_t>(helper)).is_awaiting_reply = false;
  return queue.accept(std::move(reply));
}

PricingHelper::PricingHelper(const Instance& instance)
    : instance_(instance), multipliers_(instance.world(), instance.agent_count()) {}

void PricingHelper::accept(PricingRequest request) {
  const std::lock_guard lock(mutex_);
  const auto agents = static_cast<std::int64_t>(request.known.size());
  if (request_ || agents == 0 || request.first < 0 ||
      request.first + agents > instance_.agent_count())
    throw std::invalid_argument("pricing request: invalid agents");
  multipliers_.apply(request.update);
  reply_.round = request.round;
  reply_.digest = multipliers_.digest();
  reply_.first = request.first;
  reply_.values.assign(request.known.size(), 0);
  reply_.paths.assign(request.known.size(), {});
  reply_.work = 0;
  next_ = done_ = 0;
  request_ = std::move(request);
}

std::optional<PricingJob> PricingHelper::next() {
  const std::lock_guard lock(mutex_);
  if (!request_ || next_ == request_->known.size()) return std::nullopt;
  PricingJob job;
  job.first = request_->first + static_cast<AgentIndex>(next_);
  job.end = job.first + 1;
  job.known = {request_->known[next_++]};
  return job;
}

bool PricingHelper::has_jobs() const {
  const std::lock_guard lock(mutex_);
  return request_ && next_ < request_->known.size();
}

void PricingHelper::commit(PricingJob job) {
  const std::lock_guard lock(mutex_);
  const auto at = static_cast<std::size_t>(job.first - reply_.first);
  std::ranges::copy(job.values, reply_.values.begin() + static_cast<std::ptrdiff_t>(at));
  std::ranges::move(job.paths, reply_.paths.begin() + static_cast<std::ptrdiff_t>(at));
  reply_.work += job.work;
  done_ += job.values.size();
  GROVE_CHECK(done_ <= next_, "only jobs that were given out are committed");
}

std::optional<PricingReply> PricingHelper::take_reply() {
  const std::lock_guard lock(mutex_);
  if (!request_ || done_ < request_->known.size()) return std::nullopt;
  GROVE_CHECK(multipliers_.digest() == reply_.digest,
              "the multipliers do not change before the reply");
  request_.reset();
  return std::exchange(reply_, {});
}

}  // namespace grove::detail
