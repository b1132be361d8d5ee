// SPDX-License-Identifier: MIT
// Decides when the Lagrangian bound gets effort, and distributes its jobs.
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

// The workers of a process compute the bound together. With several ranks, rank 0 owns the bound,
// and workers of the other ranks solve pricing problems for it. The scheduling rule is at the head
// of the .cpp. Thread-safe, except for open() and the functions about other ranks, which only the
// communicating thread may call.
class LagrangianScheduler {
 public:
  // `tuning` must outlive this object. due() returns false until open() or help() is called.
  explicit LagrangianScheduler(const Tuning& tuning) : tuning_(tuning) {}

  // Must be called before the search, on the rank that owns the bound. `instance` must outlive this
  // object; `stops` is copied. `records_best_multipliers`: whether to record what log_proof()
  // needs.
  void open(const Instance& instance, const AgentStopsCache& stops, bool records_best_multipliers);

  // Records `work` units of effort of the tree search and the primal search.
  void add_other_work(std::int64_t work) { others_ += work; }
  // True if the next work item should be for the bound.
  bool due(bool has_plan) const;
  // Returns the next job of the bound. Returns nullopt if no job is left or all are in progress on
  // other threads. The caller must perform and commit the job.
  std::optional<LagrangianBound::Job> next();
  bool has_jobs() const;
  void perform(LagrangianBound::Job& job, Pricer& pricer, Cost cutoff, Cost known,
               const Limits& limits);
  // Returns the proven lower bound: no plan costs less. Returns 0 if another rank owns the bound.
  Cost commit(LagrangianBound::Job job);

  // Must be called only while the caller has a job.
  Pricer pricer(const AgentStopsCache& stops) const;
  int rounds() const { return rounds_; }
  // Logs the multipliers that prove the bound. Must be called after the search.
  void log_proof(ProofLog& proof) const;
  // Returns the dual solution for the primal search. Returns nullptr if none exists yet or another
  // rank owns the bound.
  std::shared_ptr<const DualSolution> dual_solution() const;

  // Sets the number of ranks that share the search. Must be called on rank 0 before the search.
  void set_ranks(int ranks) {
    ranks_ = ranks;
    expected_work_.resize(static_cast<std::size_t>(ranks));
  }
  // Returns the pricing requests to send now, each with its receiver.
  std::vector<std::pair<int, PricingRequest>> dispatch_pricing();
  // Takes the reply from `rank`. Returns the proven lower bound: no plan costs less. Throws
  // std::invalid_argument if `rank` cannot have a request, and what LagrangianBound::accept()
  // throws.
  Cost accept(int rank, PricingReply answer);
  std::int64_t remote_pricings() const { return remote_pricings_; }

  // Takes a pricing request, which workers handle before all other work. Must be called only on
  // ranks other than 0. Throws what RemotePricing::accept() throws.
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
  std::atomic<std::int64_t> own_{0};       // effort for the bound, on all ranks
  std::atomic<std::int64_t> own_here_{0};  // effort for the bound in this process
  std::atomic<int> rounds_{0};
  std::atomic<std::int64_t> remote_pricings_{0};
  std::atomic<bool> is_over_{true};
  std::atomic<bool> helps_{false};
  int ranks_ = 1;
  std::vector<std::int64_t> expected_work_;  // by rank: expected effort of its request
  mutable std::mutex making_;                // guards the creation of the next two members
  std::unique_ptr<LagrangianBound> bound_;   // made when first due
  std::unique_ptr<RemotePricing> help_;      // made at the first request; bound_ then stays nullptr
};

}  // namespace grove::detail
