// SPDX-License-Identifier: MIT
// Lagrangian bound: a lower bound on every plan, from multipliers on collision constraints.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "lagrangian/dual_solution.h"
#include "lagrangian/finish_time_conflicts.h"
#include "lagrangian/occupancy_counts.h"
#include "lagrangian/pricer.h"
#include "lagrangian/relaxed_rows.h"
#include "lagrangian/target_level_step.h"
#include "model/tuning.h"
#include "planning/agent_stops_cache.h"

namespace grove::detail {

// Lagrangian relaxation of the root problem (no constraints of the tree). Works in rounds of jobs.
// In a round each agent's subproblem value is computed, by any number of threads and by helpers,
// which are other processes. Then the multipliers are moved. The result depends neither on timing
// nor on the order in which jobs end. Thread-safe, except that one thread calls the methods about
// helpers.
class LagrangianBound {
 public:
  // Returns nullptr if an agent has too many stops: the search keeps a mark per state and subset of
  // stops. `instance` and `tuning` must outlive the bound; it copies `stops`.
  static std::unique_ptr<LagrangianBound> make(const Instance& instance,
                                               const AgentStopsCache& stops, const Tuning& tuning);

  // A unit of work: the subproblem values of several agents or, if it has no agents, a part of the
  // work between two rounds.
  using Job = PricingJob;
  // The next job. Returns nullopt if all jobs are in progress or the bound has ended. The caller
  // must perform() and commit() the job.
  std::optional<Job> next();
  bool has_jobs() const;
  // Performs a job. `cutoff`: plans of this cost or more are of no interest. `known`: a proven
  // lower bound on every plan. If memory is refused the bound ends and keeps its value.
  void perform(Job& job, Pricer& pricer, Cost cutoff, Cost known, const Limits& limits);
  void commit(Job job);

  // Sets the number of helpers, which are numbered from 0.
  void set_helpers(int count) { helpers_.resize(static_cast<std::size_t>(count)); }
  // Pricing requests for the helpers that have answered their last one, if there is enough work.
  struct DispatchedRequest {
    int helper;
    std::int64_t work;  // expected
    PricingRequest request;
  };
  std::vector<DispatchedRequest> dispatch_pricing();
  // Processes a helper's answer. A value counts only if round and multipliers are still those of
  // the request and the agent has no value yet. Returns the number of values that counted. Throws
  // std::invalid_argument if the agents were not requested.
  int accept(int helper, PricingReply answer);

  // Records from now on the multipliers that prove lower_bound().
  void record_best_multipliers() { records_best_multipliers_ = true; }
  // The recorded multipliers, those > 0. Call it only when no job is in progress.
  const std::vector<RowMultiplier>& best_multipliers() const { return best_multipliers_; }

  // Whether the bound has ended: it has no more jobs.
  bool ended() const;
  // Proven: no plan costs less.
  Cost lower_bound() const;
  int rounds() const;
  const Multipliers& multipliers() const { return rows_.multipliers(); }
  // The dual solution of a round with the best bound so far; nullptr: none yet. It is replaced now
  // and then, when a job is committed.
  std::shared_ptr<const DualSolution> dual_solution() const;

 private:
  enum class Phase : std::uint8_t { kPricing, kBetween, kEnded };

  LagrangianBound(const Instance& instance, const AgentStopsCache& stops, const Tuning& tuning);
  // Consecutive agents for one helper.
  struct AgentRange {
    int helper;
    AgentIndex first;
    AgentIndex end;
    std::int64_t work;  // expected
  };
  struct Helper {
    std::vector<Multipliers::Amount> multipliers;  // by row: the multipliers that it has received
    bool is_awaiting_reply = false;                // an answer is outstanding
  };

  void begin_pricing();
  std::optional<Job> next_value();
  ScaledCost known_value(AgentIndex agent) const;
  std::vector<AgentRange> partition_agents();
  std::int64_t work_left() const;
  bool store_value(AgentIndex agent, ScaledCost price, Path path);
  void end_pricing_if_done();
  void note_best_multipliers();
  void do_perform(Job& job, Pricer& pricer, Cost cutoff, Cost known, const Limits& limits);
  void end_round(Job& job, Cost cutoff, Cost known, const Limits& limits);
  void separate_conflict_rows();
  void separate_finish_rows(Job& job, const Limits& limits);
  void store_dual_solution(ScaledCost bound);
  void move_multipliers(Cost cutoff, Cost known);

  const Instance& instance_;
  const Tuning& tuning_;
  AgentStopsCache stops_;  // used by pairs_
  RelaxedRows rows_;
  OccupancyCounts occupancy_;
  FinishTimeConflicts pairs_;
  TargetLevelStep ascent_;
  std::vector<Path> paths_;                // by agent: path of its subproblem value
  std::vector<ScaledCost> prices_;         // by agent
  std::vector<std::int64_t> labels_;       // by agent: mean of its last job
  std::vector<FinishTimePair> colliding_;  // pairs still to be tested in this round
  bool is_counted_ = false;                // occupancy_ is of this round
  std::int64_t next_dual_solution_round_;  // round of the next dual solution, at the earliest
  std::shared_ptr<const DualSolution> new_dual_solution_;
  std::vector<Helper> helpers_;  // used only by the thread that calls the methods about helpers
  bool records_best_multipliers_ = false;

  mutable std::mutex mutex_;  // guards:
  Phase phase_ = Phase::kPricing;
  int in_progress_ = 0;  // jobs in progress
  int rounds_ = 0;
  ScaledCost best_ = 0;
  std::vector<RowMultiplier>
      best_multipliers_;  // multipliers that prove best_, if they are recorded
  std::shared_ptr<const DualSolution> dual_solution_;
  // Agents are priced here in ascending order, and helpers are asked for the last ones. When no
  // other agents are left, those requested but not yet answered are priced here too, in descending
  // order.
  AgentIndex next_agent_ = 0;
  AgentIndex end_agent_ = 0;             // agents from here on are for helpers
  AgentIndex asked_ = 0;                 // agents from here on were requested from helpers
  AgentIndex taken_over_ = 0;            // requested agents from here on are priced here too
  std::vector<std::uint8_t> is_priced_;  // by agent
  std::vector<ScaledCost> known_;  // by agent: the cost of a known path that was sent to the helper
  int unpriced_ = 0;
  std::int64_t work_between_ = 0;  // work of the jobs between the last two rounds
};

}  // namespace grove::detail
