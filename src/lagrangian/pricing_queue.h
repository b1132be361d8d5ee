// SPDX-License-Identifier: MIT
// Queue of the jobs of a Lagrangian bound for the threads of one process.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "lagrangian/lagrangian_bound.h"
#include "lagrangian/pricer.h"

namespace grove::detail {

// Divides the rounds of a Lagrangian bound into jobs. Threads of this process price agents in
// ascending order. Another process can reserve agents at the end of the list (remote_pricing.h).
// When only reserved agents are left, the threads of this process price them as well, in descending
// order, so no thread waits for another process. Thread-safe, but only one thread at a time may
// call reserve() and requests_for().
class PricingQueue {
 public:
  // A unit of work: the subproblem values of some agents or, if the range of agents is empty, a
  // part of the update between two rounds.
  using Job = PricingJob;
  // The agents `first`, ..., `end` - 1, and the expected effort of pricing them.
  struct Range {
    AgentIndex first;
    AgentIndex end;
    std::int64_t work;
  };

  // `tuning` must outlive this object.
  PricingQueue(std::unique_ptr<LagrangianBound> bound, const Tuning& tuning);

  // Returns the next job, which the caller must perform() and then commit(). Returns nullopt if no
  // job is available now or the bound has ended.
  std::optional<Job> next();
  bool has_jobs() const;
  // Performs a job. `cutoff`: plans of this cost or more need not be considered. `known`: a proven
  // lower bound on every plan. If memory runs out or a penalty would exceed its maximum, the bound
  // ends when the job is committed, and lower_bound() keeps its value.
  void perform(Job& job, Pricer& pricer, Cost cutoff, Cost known, const Limits& limits);
  void commit(Job job);

  // Reserves agents for at most `processes` other processes, each range with an expected effort of
  // at least lagrangian_min_remote_work. Returns no range if too little work is left in this round.
  // The caller must then call request_for() for each range, and requested() afterwards.
  std::vector<Range> reserve(std::int64_t processes);
  // Returns the request for a reserved range, without `update`.
  PricingRequest request_for(const Range& range);
  // Lets this process price the reserved agents, too. `ranges`: the result of reserve().
  void requested(const std::vector<Range>& ranges);
  // Stores the values of a reply for agents that have none yet. Returns their number; 0 if the
  // round or the multipliers are not those of the request. Throws std::invalid_argument if a
  // current reply has agents that were not requested.
  int accept(PricingReply reply);

  bool ended() const;
  Cost lower_bound() const;
  int rounds() const;
  // The dual solution that was current when a job was last committed.
  std::shared_ptr<const DualSolution> dual_solution() const;
  // May be used only while the caller has a job or a reserved range.
  const Multipliers& multipliers() const { return bound_->multipliers(); }
  // May be used only while no job is in progress.
  const LagrangianBound& bound() const { return *bound_; }

 private:
  void begin_pricing();
  Job next_values();
  std::int64_t work_left() const;
  void end_pricing_if_done();
  void update(Job& job, Cost cutoff, Cost known, const Limits& limits);

  const Tuning& tuning_;
  const std::unique_ptr<LagrangianBound> bound_;

  mutable std::mutex mutex_;             // guards the members below
  int in_progress_ = 0;                  // jobs in progress
  std::vector<std::int64_t> labels_;     // by agent: mean labels per agent of its last job
  std::vector<ScaledCost> known_costs_;  // by agent: cost of a known path, as in its last request
  AgentIndex next_agent_ = 0;            // agents before this one have jobs
  AgentIndex end_agent_ = 0;             // agents from this one on are reserved
  AgentIndex requested_ = 0;             // agents from this one on were requested
  AgentIndex taken_over_ = 0;            // requested agents from this one on are priced here, too
  std::int64_t work_between_ = 0;        // effort of the update jobs since the last round
  std::shared_ptr<const DualSolution> dual_solution_;
};

}  // namespace grove::detail
