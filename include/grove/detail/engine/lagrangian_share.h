// SPDX-License-Identifier: MIT
// The Lagrangian bound, and when it is its turn.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>

#include "grove/detail/lagrangian/lagrangian_bound.h"

namespace grove::detail {

// The workers of a process find it together. The rule is at the head of the .cpp. Methods may be
// called from any thread, but for open().
class LagrangianShare {
 public:
  // `tuning` must outlive this. Until open() it is never due.
  explicit LagrangianShare(const Tuning& tuning) : tuning_(tuning) {}

  // Before the search. `instance` must outlive this.
  void open(const Instance& instance, const AgentStopsStore& stops);

  // So much was done beside it.
  void others_worked(std::int64_t work) { others_ += work; }
  // What there is to be done for it now; none: it is not its turn, or others have all in hand.
  // Whoever takes a job performs and commits it.
  std::optional<LagrangianBound::Job> next(bool has_plan);
  void perform(LagrangianBound::Job& job, Pricer& pricer, Cost cutoff, Cost known,
               const Limits& limits) {
    bound_->perform(job, pricer, cutoff, known, limits);
  }
  // Proven by now: no plan costs less.
  Cost commit(LagrangianBound::Job job);

  // Of one who has a job.
  Pricer pricer(const AgentStopsStore& stops) const { return {bound_->penalties(), stops}; }
  int rounds() const { return rounds_; }

 private:
  void make();

  const Tuning& tuning_;
  const Instance* instance_ = nullptr;
  std::optional<AgentStopsStore> stops_;
  std::atomic<std::int64_t> others_{0};
  std::atomic<std::int64_t> own_{0};
  std::atomic<int> rounds_{0};
  std::atomic<bool> is_over_{true};
  std::mutex making_;
  std::unique_ptr<LagrangianBound> bound_;  // made when it is first due, under making_
};

}  // namespace grove::detail
