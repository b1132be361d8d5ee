// SPDX-License-Identifier: MIT
// Lagrangian bound: a lower bound on the cost of every plan, from a relaxation of the collision
// constraints.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "lagrangian/dual_solution.h"
#include "lagrangian/finish_time_conflicts.h"
#include "lagrangian/occupancy_counts.h"
#include "lagrangian/relaxed_rows.h"
#include "lagrangian/target_level_step.h"
#include "model/limits.h"
#include "model/tuning.h"
#include "planning/agent_stops_cache.h"

namespace grove::detail {

// Lagrangian relaxation of the root problem, without constraints of the constraint tree: its
// multipliers, rows and ascent. Proceeds in rounds; each round has two phases:
// - Pricing: the caller computes the subproblem value of each agent under multipliers(), stores it
//   by store_value(), and calls end_pricing() when no value is missing.
// - Updating: the caller calls update() until it returns true, then begin_round().
// One thread at a time, with two exceptions: in the pricing phase any thread may read multipliers()
// and known_value() of an agent that has no value yet, and in the updating phase any thread may
// call lower_bound(), rounds() and ended() while one thread is in update().
class LagrangianBound {
 public:
  // Returns nullptr if an agent has more than ten stops, or too many for the size of the world: its
  // search stores a mark for each state and each subset of stops. `instance` and `tuning` must
  // outlive the result; `stops` is copied.
  static std::unique_ptr<LagrangianBound> make(const Instance& instance,
                                               const AgentStopsCache& stops, const Tuning& tuning);

  // From now on, records the multipliers that prove lower_bound(). Call it before the first round
  // ends.
  void record_best_multipliers() { best_.records_multipliers = true; }
  // The recorded multipliers that are > 0, with their rows.
  const std::vector<RowMultiplier>& best_multipliers() const { return best_.multipliers; }

  int agent_count() const { return instance_.agent_count(); }
  const Multipliers& multipliers() const { return rows_.multipliers(); }
  // The penalised cost of the agent's best known path under the current multipliers; kNoCost if no
  // path is known.
  ScaledCost known_value(AgentIndex agent) const;

  bool is_pricing() const { return phase_ == Phase::kPricing; }
  bool has_value(AgentIndex agent) const { return round_.has_value[agent] != 0; }
  // Number of agents without a value in this round.
  int missing_values() const { return round_.missing; }
  // Stores the subproblem value of an agent in this round: a lower bound on the penalised costs of
  // all its paths under multipliers(). `path`: the path found; empty if none was found below
  // known_value(). Returns false, and stores nothing, if the agent already has a value.
  bool store_value(AgentIndex agent, ScaledCost value, Path path);
  void end_pricing();

  // Performs a part of the update of rows and multipliers, with an effort of about
  // lagrangian_step_work, and adds this effort to `work`. `cutoff`: plans of this cost or more need
  // not be considered. Returns true when the update is complete. Throws std::bad_alloc, and
  // std::overflow_error if a penalty exceeds its maximum; the caller must then call end().
  bool update(Cost cutoff, const Limits& limits, std::int64_t& work);
  // Begins the next round or ends the bound. `known`: a proven lower bound on every plan.
  void begin_round(Cost known);
  void end() { phase_ = Phase::kEnded; }

  // True if no further round follows.
  bool ended() const { return phase_ == Phase::kEnded; }
  // The proven lower bound on the cost of every plan.
  Cost lower_bound() const;
  // Number of rounds whose pricing has ended.
  int rounds() const { return rounds_; }
  // The dual solution of a round whose bound was the best until then. Returns nullptr if there is
  // none yet. update() replaces it, but not in every round.
  const std::shared_ptr<const DualSolution>& dual_solution() const { return solutions_.latest; }

 private:
  enum class Phase : std::uint8_t { kPricing, kUpdating, kEnded };
  struct Round {
    std::vector<Path> paths;              // by agent: the path found last; empty if none
    std::vector<ScaledCost> values;       // by agent
    std::vector<std::uint8_t> has_value;  // by agent: 1 if it has a value in this round
    int missing = 0;
  };
  // Events of the round that can become rows.
  struct Events {
    bool are_counted = false;           // occupancy_ contains the paths of this round
    std::vector<FinishTimePair> pairs;  // still to be tested
  };
  struct Best {
    ScaledCost bound = 0;
    bool records_multipliers = false;
    std::vector<RowMultiplier> multipliers;  // those that prove `bound`
  };
  struct Solutions {
    std::shared_ptr<const DualSolution> latest;
    std::int64_t next_round;  // first round that may store the next one
  };

  LagrangianBound(const Instance& instance, const AgentStopsCache& stops, const Tuning& tuning);

  ScaledCost bound_of_round() const;
  void note_best_multipliers();
  void separate_conflict_rows();
  void separate_finish_rows(const Limits& limits, std::int64_t& work);
  void store_dual_solution(ScaledCost bound);
  void move_multipliers(Cost cutoff);

  const Instance& instance_;
  const Tuning& tuning_;
  AgentStopsCache stops_;  // used by pairs_
  RelaxedRows rows_;
  OccupancyCounts occupancy_;
  FinishTimeConflicts pairs_;
  TargetLevelStep ascent_;
  Phase phase_ = Phase::kPricing;
  Round round_;
  Events events_;
  bool is_stationary_ = false;  // the last direction was 0
  int rounds_ = 0;
  Best best_;
  Solutions solutions_;
};

}  // namespace grove::detail
