// SPDX-License-Identifier: MIT
// Account of the effort that a component has earned and spent.
#pragma once

#include <algorithm>
#include <cstdint>
#include <mutex>
#include <optional>

namespace grove::detail {

// Counts effort in the unit of model/effort.h, not time, so that a run is repeatable. The policy is
// at the head of scheduler.cpp. Thread-safe.
class EffortAccount {
 public:
  struct Terms {
    // A component can spend effort without credit, because its worker has nothing else to do. True:
    // each call of spend() first cancels the debt, so only the effort spent last can leave one.
    // False: debt accumulates.
    bool cancels_debt = false;
    // Maximum effort in this process per unit of effort of lower tiers in this process; nullopt: no
    // maximum.
    std::optional<double> max_local_ratio = std::nullopt;
  };

  EffortAccount() = default;
  explicit EffortAccount(const Terms& terms) : terms_(terms) {}

  // Records `effort` of lower tiers in this process, of which the component earns `rate`.
  void earn(std::int64_t effort, double rate) {
    const std::lock_guard lock(mutex_);
    lower_tier_effort_ += effort;
    credit_ += rate * static_cast<double>(effort);
  }
  // Records effort of the component in this process or, if `is_remote`, in another process. A
  // negative effort corrects an earlier estimate.
  void spend(std::int64_t effort, bool is_remote = false) {
    const std::lock_guard lock(mutex_);
    if (terms_.cancels_debt) credit_ = std::max(0.0, credit_);
    credit_ -= static_cast<double>(effort);
    if (!is_remote) spent_here_ += effort;
  }

  // Effort of lower tiers so far.
  std::int64_t lower_tier_effort() const {
    const std::lock_guard lock(mutex_);
    return lower_tier_effort_;
  }
  // True if the component may spend effort now.
  bool has_credit() const {
    const std::lock_guard lock(mutex_);
    if (credit_ < 0) return false;
    return !terms_.max_local_ratio ||
           static_cast<double>(spent_here_) <=
               *terms_.max_local_ratio * static_cast<double>(lower_tier_effort_);
  }

 private:
  const Terms terms_;
  mutable std::mutex mutex_;  // guards the members below
  std::int64_t lower_tier_effort_ = 0;
  double credit_ = 0;  // earned minus spent
  std::int64_t spent_here_ = 0;
};

}  // namespace grove::detail
