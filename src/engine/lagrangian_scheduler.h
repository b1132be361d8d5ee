// SPDX-License-Identifier: MIT
// The Lagrangian bound, and when it is its turn.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "lagrangian/lagrangian_bound.h"
#include "lagrangian/remote_pricing.h"
#include "search/proof_log.h"

namespace grove::detail {

// The workers of a process find it together, and where ranks share the search, those of others find
// prices for them. The rule is at the head of the .cpp. Methods may be called from any thread, but
// those about ranks, which are for the one that speaks, and open().
class LagrangianScheduler {
 public:
  // `tuning` must outlive this. Until open() it is never due.
  explicit LagrangianScheduler(const Tuning& tuning) : tuning_(tuning) {}

  // Before the search. `instance` must outlive this. `keeps_reasons`: for log_proof().
  void open(const Instance& instance, const AgentStopsCache& stops, bool keeps_reasons);

  // So much was done beside it.
  void add_other_work(std::int64_t work) { others_ += work; }
  // Is it its turn?
  bool due(bool has_plan) const;
  // What there is to be done for it; none: nothing, or others have all in hand. Whoever takes a job
  // performs and commits it.
  std::optional<LagrangianBound::Job> next();
  bool has_jobs() const;
  void perform(LagrangianBound::Job& job, Pricer& pricer, Cost cutoff, Cost known,
               const Limits& limits);
  // Proven by now: no plan costs less.
  Cost commit(LagrangianBound::Job job);

  // Of one who has a job.
  Pricer pricer(const AgentStopsCache& stops) const;
  int rounds() const { return rounds_; }
  // After the search: why the bound holds.
  void log_proof(ProofLog& proof) const;
  // For the search for plans; null: none yet, or the bound is another rank's.
  std::shared_ptr<const DualSolution> price_list() const;

  // On rank 0, before the search: so many ranks share it.
  void set_ranks(int ranks) {
    ranks_ = ranks;
    asked_of_.resize(static_cast<std::size_t>(ranks));
  }
  // Which ranks to ask for prices now, and for which.
  std::vector<std::pair<int, PricingRequest>> dispatch_pricing();
  // What that rank has found. Proven by now: no plan costs less.
  Cost accept(int rank, PricingReply answer);
  std::int64_t prices_of_ranks() const { return prices_of_ranks_; }

  // On another rank: what it is asked for; all other work can wait. Throws as
  // RemotePricing::accept().
  void help(const Instance& instance, PricingRequest share);
  std::optional<PricingReply> take_answer();

 private:
  void make();
  LagrangianBound* bound() const;
  Cost heard_of_bound();

  const Tuning& tuning_;
  const Instance* instance_ = nullptr;
  std::optional<AgentStopsCache> stops_;
  bool keeps_reasons_ = false;
  std::atomic<std::int64_t> others_{0};
  std::atomic<std::int64_t> own_{0};       // that of other ranks too
  std::atomic<std::int64_t> own_here_{0};  // without it
  std::atomic<int> rounds_{0};
  std::atomic<std::int64_t> prices_of_ranks_{0};
  std::atomic<bool> is_over_{true};
  std::atomic<bool> helps_{false};
  int ranks_ = 1;
  std::vector<std::int64_t> asked_of_;      // by rank: the work that its answer should take
  mutable std::mutex making_;               // guards the making of what follows:
  std::unique_ptr<LagrangianBound> bound_;  // when it is first due
  std::unique_ptr<RemotePricing> help_;     // when help is first asked for; then there is no bound_
};

}  // namespace grove::detail
