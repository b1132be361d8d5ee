// SPDX-License-Identifier: MIT
// A bound on all plans from prices instead of collisions: a Lagrangian relaxation.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "grove/detail/lagrangian/encounters.h"
#include "grove/detail/lagrangian/finish_pairs.h"
#include "grove/detail/lagrangian/level_ascent.h"
#include "grove/detail/lagrangian/penalized_search.h"
#include "grove/detail/lagrangian/relaxed_rows.h"
#include "grove/detail/model/tuning.h"
#include "grove/detail/planning/agent_stops_store.h"

namespace grove::detail {

// What one thread prices agents with. Not of those that others have.
class Pricer {
 public:
  Pricer(const Penalties& penalties, const AgentStopsStore& stops)
      : stops_(stops), search_(penalties) {}

  FreeGoals& goals(AgentIndex agent);
  PenalizedSearch& search() { return search_; }

 private:
  AgentStopsStore stops_;
  PenalizedSearch search_;
  std::vector<std::unique_ptr<FreeGoals>> goals_;  // by agent
};

// The instance at the root, without any demand. Rounds of jobs: every agent gets its price, which
// any number of threads may find side by side; then the multipliers are moved. What happens depends
// on no clock and on no order in which jobs end. Methods may be called from any thread.
class LagrangianBound {
 public:
  // None: not for this method, for an agent may have done too many things to keep a price for each.
  // Both must outlive it, but for `stops`, of which it makes a copy.
  static std::unique_ptr<LagrangianBound> make(const Instance& instance,
                                               const AgentStopsStore& stops, const Tuning& tuning);

  // What is done at one go: the prices of some agents, or a part of what follows in a round.
  struct Job {
    AgentIndex first = 0;
    AgentIndex end = 0;  // none to price: the other thing
    std::vector<Price> prices;
    std::vector<Path> paths;  // empty: as before
    std::int64_t work = 0;    // in the unit of search/work.h
    bool failed = false;      // memory was refused: nothing of it counts
  };
  // The next one; none: all are in hand, or it has ended. Whoever takes one performs it and commits
  // it.
  std::optional<Job> next();
  // `cutoff`: plans that cost so much or more are of no interest. `known`: no plan costs less.
  // Where memory is refused it ends, and keeps the bound that it has.
  void perform(Job& job, Pricer& pricer, Cost cutoff, Cost known, const Limits& limits);
  void commit(Job job);

  // Nothing is to be gained any more.
  bool ended() const;
  // Proven: no plan costs less.
  Cost lower_bound() const;
  int rounds() const;
  const Penalties& penalties() const { return rows_.penalties(); }

 private:
  enum class Phase : std::uint8_t { kPricing, kBetween, kEnded };

  LagrangianBound(const Instance& instance, const AgentStopsStore& stops, const Tuning& tuning);
  void do_perform(Job& job, Pricer& pricer, Cost cutoff, Cost known, const Limits& limits);
  void price(Job& job, Pricer& pricer, const Limits& limits) const;
  Price first_price(AgentIndex agent, FreeGoals& goals, PenalizedSearch& search,
                    const Limits& limits, Path& path) const;
  Price price_below(Price below, AgentIndex agent, FreeGoals& goals, PenalizedSearch& search,
                    const Limits& limits, Path& path) const;
  void end_round(Job& job, Cost cutoff, Cost known, const Limits& limits);
  void look_at_collisions();
  void look_at_pairs(Job& job, const Limits& limits);
  void move_multipliers(Cost cutoff, Cost known);

  const Instance& instance_;
  const Tuning& tuning_;
  AgentStopsStore stops_;  // of pairs_
  RelaxedRows rows_;
  Encounters encounters_;
  FinishPairs pairs_;
  LevelAscent ascent_;
  std::vector<Path> paths_;            // by agent: of its price in this round
  std::vector<Price> prices_;          // by agent
  std::vector<std::int64_t> labels_;   // by agent: that its price took last
  std::vector<FinishPair> colliding_;  // still to be looked at in this round
  bool is_counted_ = false;            // of this round

  mutable std::mutex mutex_;  // guards:
  Phase phase_ = Phase::kPricing;
  AgentIndex next_agent_ = 0;
  int in_hand_ = 0;  // jobs
  int rounds_ = 0;
  Price best_ = 0;
};

}  // namespace grove::detail
