// SPDX-License-Identifier: MIT
// Low level of the primal heuristics: finds one agent's path around the agents planned so far.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "lagrangian/dual_solution.h"
#include "lagrangian/pricer.h"
#include "model/effort.h"
#include "planning/agent_stops_cache.h"
#include "planning/free_order_sipp.h"
#include "planning/problem.h"

namespace grove::detail {

// Free-order SIPP, which also chooses the order of the agent's tasks, with cached data of every
// agent. One thread at a time.
class PrimalLowLevel {
 public:
  // Both references must outlive this object.
  PrimalLowLevel(const Problem& problem, AgentStopsCache& stops);

  // Individual planning: finds the agent's best path without the other agents, or a good path if
  // the agent has too many sequences to find the best one. Must be called for an agent before any
  // other function is used for it. Returns false if a limit was reached.
  bool plan_individually(AgentIndex agent, const Limits& limits);

  // Finds a path of the agent; see FreeOrderSipp::find().
  PathOutcome find(AgentIndex agent, const PathQuery& query, const Limits& limits, Path& path);

  // Sets the dual solution, which must not be nullptr.
  void use(std::shared_ptr<const DualSolution> dual_solution);
  // The current dual solution; nullptr if none was set.
  const DualSolution* dual_solution() const { return dual_solution_.get(); }
  // Number of calls of use().
  int price_changes() const { return price_changes_; }
  // Replaces `path`, a path around `others`, by a path around them that finishes by `latest` and
  // has the least penalised cost. Keeps `path` if the search finds no path of lower penalised cost.
  // Requires a dual solution.
  void improve(AgentIndex agent, const ReservationTable& others, Time latest, const Limits& limits,
               Path& path);

  // True if the individual path is proven to be optimal.
  bool knows_best(AgentIndex agent) const { return in_order_[agent] == nullptr; }
  // The path found by plan_individually(), and its cost.
  const Path& individual_path(AgentIndex agent) const { return own_paths_[agent]; }
  Time individual_cost(AgentIndex agent) const {
    return static_cast<Time>(own_paths_[agent].size()) - 1;
  }
  // The order in which the individual path visits the agent's stops.
  Sequence individual_order(AgentIndex agent) const {
    return realized_sequence(*goals_[agent], own_paths_[agent]);
  }

  // Returns the plan that consists of `paths`, by AgentIndex.
  Plan plan(const std::vector<Path>& paths);

  std::int64_t calls() const { return calls_; }
  std::int64_t expanded() const { return low_level_.expanded(); }
  std::int64_t work() const {
    const std::int64_t labels = labels_before_ + (priced_ ? priced_->labels() : 0);
    return expanded() + labels / effort::kPricedLabels + effort::kUnitsPerCall * calls_;
  }

 private:
  SequenceStages& goals(AgentIndex agent);
  bool follow_good_sequence(AgentIndex agent, const Limits& limits);

  const Problem& problem_;
  AgentStopsCache& stops_;
  FreeOrderSipp low_level_;
  // By AgentIndex: for an agent that follows one good sequence, the costs to go of this sequence;
  // else nullptr.
  std::vector<std::unique_ptr<CostToGo>> in_order_;
  std::vector<std::unique_ptr<SequenceStages>> goals_;
  std::vector<Path> own_paths_;  // individual paths, by AgentIndex
  std::int64_t calls_ = 0;
  std::shared_ptr<const DualSolution> dual_solution_;
  int price_changes_ = 0;
  std::optional<PenalizedSearch> priced_;  // search with the penalties of dual_solution_
  std::int64_t labels_before_ = 0;         // labels of the searches with earlier dual solutions
};

}  // namespace grove::detail
