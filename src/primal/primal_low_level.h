// SPDX-License-Identifier: MIT
// One agent's way around those already planned.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "lagrangian/dual_solution.h"
#include "lagrangian/pricer.h"
#include "planning/agent_stops_cache.h"
#include "planning/free_order_sipp.h"
#include "search/problem.h"
#include "search/work.h"

namespace grove::detail {

// The low level with what it needs of every agent. Each agent chooses the order of its tasks.
class PrimalLowLevel {
 public:
  // Both must outlive this.
  PrimalLowLevel(const Problem& problem, AgentStopsCache& stops);

  // Finds the agent's best path without other agents, or a good one if its sequences are too
  // many to tell; to be called for an agent before any other question about it. Returns false if a
  // limit was reached.
  bool meet(AgentIndex agent, const Limits& limits);

  // As FreeOrderSipp::find.
  PathOutcome find(AgentIndex agent, const PathQuery& query, const Limits& limits, Path& path);

  // From now on it is known what is dear.
  void use(std::shared_ptr<const DualSolution> prices);
  // Null: nothing is known.
  const DualSolution* prices() const { return prices_.get(); }
  // How often that has changed.
  int price_changes() const { return price_changes_; }
  // Puts in the place of a path around others the one that is cheapest by the prices, if that
  // finishes by `latest`. There must be prices.
  void improve(AgentIndex agent, const ReservationTable& others, Time latest, const Limits& limits,
               Path& path);

  // Is the own path proven to be the best?
  bool knows_best(AgentIndex agent) const { return in_order_[agent] == nullptr; }
  // The agent's best or good path without other agents, and its cost.
  const Path& individual_path(AgentIndex agent) const { return own_paths_[agent]; }
  Time individual_cost(AgentIndex agent) const {
    return static_cast<Time>(own_paths_[agent].size()) - 1;
  }
  // The order in which that path visits the agent's stops.
  Sequence individual_order(AgentIndex agent) const {
    return realized_sequence(*goals_[agent], own_paths_[agent]);
  }

  // The plan that `paths`, by AgentIndex, make.
  Plan plan(const std::vector<Path>& paths);

  std::int64_t calls() const { return calls_; }
  std::int64_t expanded() const { return low_level_.expanded(); }
  std::int64_t work() const {
    const std::int64_t labels = labels_before_ + (priced_ ? priced_->labels() : 0);
    return expanded() + labels / kLabelsPerWork + work::kPerCall * calls_;
  }

 private:
  SequenceStages& goals(AgentIndex agent);
  bool follow_good_sequence(AgentIndex agent, const Limits& limits);

  const Problem& problem_;
  AgentStopsCache& stops_;
  FreeOrderSipp low_level_;
  // By AgentIndex. Of an agent that follows a good sequence: its completions.
  std::vector<std::unique_ptr<CostToGo>> in_order_;
  std::vector<std::unique_ptr<SequenceStages>> goals_;
  std::vector<Path> own_paths_;  // by AgentIndex
  std::int64_t calls_ = 0;
  std::shared_ptr<const DualSolution> prices_;
  int price_changes_ = 0;
  std::optional<PenalizedSearch> priced_;  // by them
  std::int64_t labels_before_ = 0;         // by those before
};

}  // namespace grove::detail
