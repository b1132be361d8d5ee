// SPDX-License-Identifier: MIT
// Remote pricing: one process, the owner of a Lagrangian bound, lets others (*helpers*) compute
// subproblem values. The caller transports the messages.
#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <vector>

#include "lagrangian/pricer.h"
#include "lagrangian/pricing_queue.h"
#include "model/instance.h"

namespace grove::detail {

// The owner's side. Stores for each helper whether a reply is outstanding and which multipliers it
// has. Helpers are numbered from 0. One thread at a time.
class PricingDispatcher {
 public:
  explicit PricingDispatcher(int helpers) : helpers_(static_cast<std::size_t>(helpers)) {}

  struct Dispatch {
    int helper;
    std::int64_t work;  // expected effort, in the unit of model/effort.h
    PricingRequest request;
  };
  // Returns requests for helpers without an outstanding reply, which the caller must send. Returns
  // none if too little work is left in this round.
  std::vector<Dispatch> dispatch(PricingQueue& queue);
  // Processes a helper's reply. Returns the number of values used; see PricingQueue::accept(),
  // whose exceptions it passes on.
  int accept(int helper, PricingReply reply, PricingQueue& queue);

 private:
  struct Helper {
    std::vector<Multipliers::Amount> multipliers;  // by row: the multiplier that was sent last
    bool is_awaiting_reply = false;                // to the request that was sent last
  };
  std::vector<Helper> helpers_;
};

// A helper's side. Stores a copy of the owner's multipliers and the current request, and makes one
// job of each agent in the request. Thread-safe, but multipliers() may be used only while the
// caller has a job.
class PricingHelper {
 public:
  // `instance` must outlive this object.
  explicit PricingHelper(const Instance& instance);

  // Accepts a request and updates the multipliers. Throws std::invalid_argument if the request is
  // invalid, or if take_reply() has not returned the reply to the previous request.
  void accept(PricingRequest request);
  // Returns the next job of the request, which the caller must perform with a Pricer and then
  // commit(). Returns nullopt if there is none.
  std::optional<PricingJob> next();
  bool has_jobs() const;
  void commit(PricingJob job);
  // Returns the reply to the current request, once, after all of its jobs are committed; nullopt
  // otherwise.
  std::optional<PricingReply> take_reply();

  const Multipliers& multipliers() const { return multipliers_; }

 private:
  const Instance& instance_;
  Multipliers multipliers_;  // changes only when no job is in progress
  mutable std::mutex mutex_;
  std::optional<PricingRequest> request_;  // current request; mutex_ guards it and all below
  PricingReply reply_;
  std::size_t next_ = 0;  // position of the next job in the request
  std::size_t done_ = 0;
};

}  // namespace grove::detail
