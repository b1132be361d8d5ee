// SPDX-License-Identifier: MIT
// A bound on all plans from prices instead of collisions: a Lagrangian relaxation.
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
#include "lagrangian/pricing_messages.h"
#include "lagrangian/relaxed_rows.h"
#include "lagrangian/target_level_step.h"
#include "model/tuning.h"
#include "planning/agent_stops_cache.h"

namespace grove::detail {

// The instance at the root, without any demand. Rounds of jobs: every agent gets its price, which
// any number of threads may find side by side, and other processes; then the multipliers are moved.
// What happens depends on no clock and on no order in which jobs end. Methods may be called from
// any thread, but those about helpers: these by one.
class LagrangianBound {
 public:
  // None: not for this method, for an agent may have done too many things to keep a price for each.
  // Both must outlive it, but for `stops`, of which it makes a copy.
  static std::unique_ptr<LagrangianBound> make(const Instance& instance,
                                               const AgentStopsCache& stops, const Tuning& tuning);

  // What is done at one go: the prices of some agents, or, if of none, a part of what follows in a
  // round.
  using Job = PricingJob;
  // The next one; none: all are in hand, or it has ended. Whoever takes one performs it and commits
  // it.
  std::optional<Job> next();
  bool has_jobs() const;
  // `cutoff`: plans that cost so much or more are of no interest. `known`: no plan costs less.
  // Where memory is refused it ends, and keeps the bound that it has.
  void perform(Job& job, Pricer& pricer, Cost cutoff, Cost known, const Limits& limits);
  void commit(Job job);

  // There are others, numbered from 0, who may be asked for prices.
  void set_helpers(int count) { helpers_.resize(static_cast<std::size_t>(count)); }
  // Whom to ask now, and what for: those who have answered, if there is enough to be done.
  struct Asked {
    int helper;
    std::int64_t work;  // that it will probably take
    PricingRequest share;
  };
  std::vector<Asked> dispatch_pricing();
  // What this one was asked for. Counts if the round is still that one and nobody else has found
  // those prices. Returns how many did.
  int accept(int helper, PricingReply answer);

  // From now on, remembers by which charges it has the bound that it has.
  void record_best_multipliers() { keeps_reasons_ = true; }
  // Once no job is in hand.
  const std::vector<RowMultiplier>& reasons() const { return reasons_; }

  // Nothing is to be gained any more.
  bool ended() const;
  // Proven: no plan costs less.
  Cost lower_bound() const;
  int rounds() const;
  const Multipliers& multipliers() const { return rows_.multipliers(); }
  // Of a round with the best bound so far, a new one now and then; null: none yet. It appears when
  // a job is committed.
  std::shared_ptr<const DualSolution> price_list() const;

 private:
  enum class Phase : std::uint8_t { kPricing, kBetween, kEnded };

  LagrangianBound(const Instance& instance, const AgentStopsCache& stops, const Tuning& tuning);
  // To be asked of a helper: agents in a row.
  struct AgentRange {
    int helper;
    AgentIndex first;
    AgentIndex end;
    std::int64_t work;  // expected
  };
  struct Helper {
    std::vector<Multipliers::Amount> charges;  // that it knows
    bool owes = false;                         // an answer
  };

  void begin_pricing();
  std::optional<Job> next_price();
  ScaledCost known_price(AgentIndex agent) const;
  std::vector<AgentRange> partition_agents();
  std::int64_t work_left() const;
  bool take_price(AgentIndex agent, ScaledCost price, Path path);
  void end_pricing_if_done();
  void note_best_multipliers();
  void do_perform(Job& job, Pricer& pricer, Cost cutoff, Cost known, const Limits& limits);
  void end_round(Job& job, Cost cutoff, Cost known, const Limits& limits);
  void separate_conflict_rows();
  void separate_finish_rows(Job& job, const Limits& limits);
  void make_list(ScaledCost bound);
  void move_multipliers(Cost cutoff, Cost known);

  const Instance& instance_;
  const Tuning& tuning_;
  AgentStopsCache stops_;  // of pairs_
  RelaxedRows rows_;
  OccupancyCounts encounters_;
  FinishTimeConflicts pairs_;
  TargetLevelStep ascent_;
  std::vector<Path> paths_;                    // by agent: of its price in this round
  std::vector<ScaledCost> prices_;             // by agent
  std::vector<std::int64_t> labels_;           // by agent: that its price took last
  std::vector<FinishTimeConflict> colliding_;  // still to be looked at in this round
  bool is_counted_ = false;                    // of this round
  std::int64_t next_list_;                     // in rounds: not before
  std::shared_ptr<const DualSolution> new_list_;
  std::vector<Helper> helpers_;  // of the one thread that asks them
  bool keeps_reasons_ = false;

  mutable std::mutex mutex_;  // guards:
  Phase phase_ = Phase::kPricing;
  int in_hand_ = 0;  // jobs
  int rounds_ = 0;
  ScaledCost best_ = 0;
  std::vector<RowMultiplier> reasons_;  // for it, if they are kept
  std::shared_ptr<const DualSolution> list_;
  // Agents are priced here from the first one on, and helpers are asked for the last ones; when
  // there are no others left, also for those not yet answered, from the last one back.
  AgentIndex next_agent_ = 0;
  AgentIndex end_agent_ = 0;             // not to be asked for any more; from here on helpers are
  AgentIndex asked_ = 0;                 // and were
  AgentIndex taken_over_ = 0;            // from here on
  std::vector<std::uint8_t> is_priced_;  // by agent
  std::vector<ScaledCost> known_;        // by agent: what helpers were told
  int unpriced_ = 0;
  std::int64_t work_between_ = 0;  // when the multipliers were moved last
};

}  // namespace grove::detail
