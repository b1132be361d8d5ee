// SPDX-License-Identifier: MIT
// Schedules the work of the Lagrangian bound.
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

// The workers of a process compute the bound together. With several ranks, those of the other ranks
// price agents for it. The rule is at the head of the .cpp. Thread-safe, except for open() and the
// methods about ranks. Only the communicating thread calls the latter.
class LagrangianScheduler {
 public:
  // `tuning` must outlive this. Before open(), due() returns false unless help() was called.
  explicit LagrangianScheduler(const Tuning& tuning) : tuning_(tuning) {}

  // Call before the search. `instance` must outlive this. `keeps_reasons`: keep what log_proof()
  // needs.
  void open(const Instance& instance, const AgentStopsCache& stops, bool keeps_reasons);

  // Adds `work` units of other work: tree search and primal search.
  void add_other_work(std::int64_t work) { others_ += work; }
  // True if the next work item is the bound's.
  bool due(bool has_plan) const;
  // Returns the next job of the bound, or nullopt if there is none or other threads have all of
  // them in progress. The caller performs and commits the job.
  std::optional<LagrangianBound::Job> next();
  bool has_jobs() const;
  void perform(LagrangianBound::Job& job, Pricer& pricer, Cost cutoff, Cost known,
               const Limits& limits);
  // Returns the proven lower bound: no plan costs less. 0 where another rank owns the bound.
  Cost commit(LagrangianBound::Job job);

  // Call only while the caller has a job.
  Pricer pricer(const AgentStopsCache& stops) const;
  int rounds() const { return rounds_; }
  // Call after the search. Logs the multipliers that prove the bound.
  void log_proof(ProofLog& proof) const;
  // Returns the dual solution for the primal search, or nullptr if there is none yet or another
  // rank owns the bound.
  std::shared_ptr<const DualSolution> dual_solution() const;

  // Call on rank 0 before the search: `ranks` ranks share it.
  void set_ranks(int ranks) {
    ranks_ = ranks;
    asked_of_.resize(static_cast<std::size_t>(ranks));
  }
  // Returns the pricing requests to send now, with their ranks.
  std::vector<std::pair<int, PricingRequest>> dispatch_pricing();
  // Takes the reply of `rank`. Returns the proven lower bound: no plan costs less. Throws
  // std::invalid_argument if `rank` cannot have a request.
  Cost accept(int rank, PricingReply answer);
  std::int64_t remote_pricings() const { return prices_of_ranks_; }

  // Call on a rank other than 0: takes a pricing request, which precedes all other work. Throws as
  // RemotePricing::accept().
  void help(const Instance& instance, PricingRequest request);
  std::optional<PricingReply> take_answer();

 private:
  void make();
  LagrangianBound* bound() const;
  Cost update_from_bound();

  const Tuning& tuning_;
  const Instance* instance_ = nullptr;
  std::optional<AgentStopsCache> stops_;
  bool records_best_multipliers_ = false;
  std::atomic<std::int64_t> others_{0};
  std::atomic<std::int64_t> own_{0};       // includes work of other ranks
  std::atomic<std::int64_t> own_here_{0};  // on this process
  std::atomic<int> rounds_{0};
  std::atomic<std::int64_t> prices_of_ranks_{0};
  std::atomic<bool> is_over_{true};
  std::atomic<bool> helps_{false};
  int ranks_ = 1;
  std::vector<std::int64_t> asked_of_;      // by rank: expected work of its request
  mutable std::mutex making_;               // guards the creation of the next two:
  std::unique_ptr<LagrangianBound> bound_;  // made when first due
  std::unique_ptr<RemotePricing> help_;     // made at the first request; then bound_ stays null
};

}  // namespace grove::detail
