// SPDX-License-Identifier: MIT
// Remote pricing: computes subproblem values for the Lagrangian bound of another process.
#pragma once

#include <cstddef>
#include <mutex>
#include <optional>

#include "lagrangian/pricer.h"
#include "model/instance.h"

namespace grove::detail {

// A helper's side of LagrangianBound. Stores a copy of the other process's multipliers and the
// current pricing request, and makes one job of each agent in the request. Thread-safe, but
// multipliers() may be used only while the caller has a job.
class RemotePricing {
 public:
  // `instance` must outlive this object.
  explicit RemotePricing(const Instance& instance);

  // Accepts a request and updates the multipliers. Throws std::invalid_argument if the request is
  // invalid, or if take_answer() has not returned the reply to the previous request.
  void accept(PricingRequest request);
  // Returns the next job of the request, which the caller must perform with a Pricer and then
  // commit(). Returns nullopt if there is none.
  std::optional<PricingJob> next();
  bool has_jobs() const;
  void commit(PricingJob job);
  // Returns the reply to the current request, once, after all of its jobs are committed; nullopt
  // otherwise.
  std::optional<PricingReply> take_answer();

  const Multipliers& multipliers() const { return multipliers_; }

 private:
  const Instance& instance_;
  Multipliers multipliers_;  // changes only when no job is in progress
  mutable std::mutex mutex_;
  std::optional<PricingRequest> request_;  // current request; mutex_ guards it and all below
  PricingReply answer_;
  std::size_t next_ = 0;  // position of the next job in the request
  std::size_t done_ = 0;
};

}  // namespace grove::detail
