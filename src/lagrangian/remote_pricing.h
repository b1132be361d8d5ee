// SPDX-License-Identifier: MIT
// Remote pricing: subproblem values for a Lagrangian bound in another process.
#pragma once

#include <cstddef>
#include <mutex>
#include <optional>

#include "lagrangian/pricer.h"
#include "model/instance.h"

namespace grove::detail {

// Holds a copy of the other process's multipliers and the current pricing request, whose agents are
// separate jobs. Thread-safe.
class RemotePricing {
 public:
  // `instance` must outlive this.
  explicit RemotePricing(const Instance& instance);

  // Accepts the next request; the last one must have been answered. Throws std::invalid_argument if
  // the request is invalid.
  void accept(PricingRequest request);
  // The next job. Returns nullopt if there is none. The caller must perform and commit() it.
  std::optional<PricingJob> next();
  bool has_jobs() const;
  void commit(PricingJob job);
  // The reply to the request, once, when all its jobs are committed; nullopt otherwise.
  std::optional<PricingReply> take_answer();

  const Multipliers& multipliers() const { return multipliers_; }

 private:
  const Instance& instance_;
  Multipliers multipliers_;  // changes only when no job is in progress
  mutable std::mutex mutex_;
  std::optional<PricingRequest> share_;  // not answered yet; mutex_ guards it and all below
  PricingReply answer_;
  std::size_t next_ = 0;  // entry of the request
  std::size_t done_ = 0;
};

}  // namespace grove::detail
