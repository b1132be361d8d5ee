// SPDX-License-Identifier: MIT
// Lagrangian bound: a lower bound on the cost of every plan, from a relaxation of the collision
// constraints.
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

// Lagrangian relaxation of the root problem, without constraints of the constraint tree. Proceeds
// in rounds. In each round, threads of this process and *helpers* (other processes) compute the
// subproblem value of each agent; then one thread updates the multipliers. next(), has_jobs(),
// perform(), commit(), ended(), lower_bound(), rounds() and dual_solution() are thread-safe. The
// methods for helpers are called by one thread at a time.
class LagrangianBound {
 public:
  // Returns nullptr if an agent has more than ten stops, or too many for the size of the world: its
  // search stores a mark for each state and each subset of stops. `instance` and `tuning` must
  // outlive the result; `stops` is copied.
  static std::unique_ptr<LagrangianBound> make(const Instance& instance,
                                               const AgentStopsCache& stops, const Tuning& tuning);

  // A unit of work: the subproblem values of some agents or, if the range of agents is empty, a
  // part of the computation between two rounds.
  using Job = PricingJob;
  // Returns the next job, which the caller must perform() and then commit(). Returns nullopt if no
  // job is available now or the bound has ended.
  std::optional<Job> next();
  bool has_jobs() const;
  // Performs a job. `cutoff`: plans of this cost or more are of no interest. `known`: a proven
  // lower bound on every plan. If memory runs out or a penalty would exceed its maximum, the bound
  // ends when the job is committed, and lower_bound() keeps its value.
  void perform(Job& job, Pricer& pricer, Cost cutoff, Cost known, const Limits& limits);
  void commit(Job job);

  // Sets the number of helpers, which are numbered from 0.
  void set_helpers(int count) { helpers_.resize(static_cast<std::size_t>(count)); }
  // A pricing request for a helper.
  struct DispatchedRequest {
    int helper;
    std::int64_t work;  // expected effort, in the unit of model/effort.h
    PricingRequest request;
  };
  // Returns pricing requests for helpers without an outstanding request. Returns none if there is
  // too little work left in this round. The caller must send them.
  std::vector<DispatchedRequest> dispatch_pricing();
  // Processes a helper's reply. Uses a value only if the round and the multipliers are still those
  // of the request and the agent has no value yet. Returns the number of values used. Returns 0 for
  // a reply that is late. Throws std::invalid_argument if a current reply has agents that were not
  // requested.
  int accept(int helper, PricingReply answer);

  // From now on, records the multipliers that prove lower_bound(). Call it before the first job.
  void record_best_multipliers() { records_best_multipliers_ = true; }
  // The recorded multipliers that are > 0, with their rows. Call it only while no job is in
  // progress.
  const std::vector<RowMultiplier>& best_multipliers() const { return best_multipliers_; }

  // True if the bound has ended: next() returns no more jobs.
  bool ended() const;
  // The proven lower bound on the cost of every plan.
  Cost lower_bound() const;
  int rounds() const;
  const Multipliers& multipliers() const { return rows_.multipliers(); }
  // The dual solution of a round whose bound was the best until then. Returns nullptr if there is
  // none yet. It is not updated in every round.
  std::shared_ptr<const DualSolution> dual_solution() const;

 private:
  enum class Phase : std::uint8_t { kPricing, kBetween, kEnded };

  LagrangianBound(const Instance& instance, const AgentStopsCache& stops, const Tuning& tuning);
  // The agents `first`, ..., `end` - 1, for one helper.
  struct AgentRange {
    int helper;
    AgentIndex first;
    AgentIndex end;
    std::int64_t work;  // expected
  };
  struct Helper {
    std::vector<Multipliers::Amount> multipliers;  // by row: the multiplier that was sent last
    bool is_awaiting_reply = false;                // its reply is outstanding
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
  std::vector<Path> paths_;                // by agent: the best path found; empty: none
  std::vector<ScaledCost> values_;         // by agent
  std::vector<std::int64_t> labels_;       // by agent: mean labels per agent of its last job
  std::vector<FinishTimePair> colliding_;  // events still to be tested in this round
  bool is_counted_ = false;                // occupancy_ contains the paths of this round
  std::int64_t next_dual_solution_round_;  // first round that may store the next dual solution
  std::shared_ptr<const DualSolution> new_dual_solution_;
  std::vector<Helper> helpers_;  // used only by the thread that calls the methods for helpers
  bool records_best_multipliers_ = false;

  mutable std::mutex mutex_;  // guards the members below
  Phase phase_ = Phase::kPricing;
  int in_progress_ = 0;  // jobs in progress
  int rounds_ = 0;
  ScaledCost best_ = 0;
  std::vector<RowMultiplier> best_multipliers_;  // recorded multipliers that prove best_
  std::shared_ptr<const DualSolution> dual_solution_;
  // This process computes subproblem values in ascending order of agents, and requests values of
  // the last agents from helpers. When only requested agents are left, it computes their
  // outstanding values as well, in descending order.
  AgentIndex next_agent_ = 0;
  AgentIndex end_agent_ = 0;             // agents from this one on are assigned to helpers
  AgentIndex asked_ = 0;                 // agents from this one on were requested from helpers
  AgentIndex taken_over_ = 0;            // requested agents from this one on are computed here, too
  std::vector<std::uint8_t> is_priced_;  // by agent
  std::vector<ScaledCost> known_costs_;  // by agent: cost of a known path, as sent to a helper
  int unpriced_ = 0;
  std::int64_t work_between_ = 0;  // work of the jobs after the last round
};

}  // namespace grove::detail
