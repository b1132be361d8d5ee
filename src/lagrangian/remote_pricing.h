// SPDX-License-Identifier: MIT
// Prices for a Lagrangian bound that is in another process.
#pragma once

#include <cstddef>
#include <mutex>
#include <optional>

#include "lagrangian/pricer.h"
#include "lagrangian/pricing_messages.h"
#include "model/instance.h"

namespace grove::detail {

// A copy of the tariff there, and a share of the agents: one after the other, each a job for any
// thread. Methods may be called from any thread.
class RemotePricing {
 public:
  // `instance` must outlive this.
  explicit RemotePricing(const Instance& instance);

  // The next share, when the last one was answered. Throws std::invalid_argument for what cannot be
  // asked for.
  void accept(PricingRequest share);
  // The next job; none: all are in hand. Whoever takes one performs and commits it.
  std::optional<PricingJob> next();
  bool has_jobs() const;
  void commit(PricingJob job);
  // All that was asked for, once, when it is done.
  std::optional<PricingReply> take_answer();

  const Multipliers& multipliers() const { return multipliers_; }

 private:
  const Instance& instance_;
  Multipliers multipliers_;  // changes only when no job is in hand
  mutable std::mutex mutex_;
  std::optional<PricingRequest> share_;  // not answered yet; under mutex_, as is the rest
  PricingReply answer_;
  std::size_t next_ = 0;  // of the share
  std::size_t done_ = 0;
};

}  // namespace grove::detail
