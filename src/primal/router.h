// SPDX-License-Identifier: MIT
// One agent's way around those already planned.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "grove/detail/planning/agent_stops_store.h"
#include "grove/detail/planning/free_low_level_search.h"
#include "grove/detail/search/problem.h"
#include "grove/detail/search/work.h"

namespace grove::detail {

// The low level with what it needs of every agent. Each agent chooses the order of its tasks.
class Router {
 public:
  // Both must outlive this.
  Router(const Problem& problem, AgentStopsStore& stops);

  // Finds the agent's best path when nobody else is there; to be called for an agent before any
  // other question about it. False when a limit struck.
  bool meet(AgentIndex agent, const Limits& limits);

  // As FreeLowLevelSearch::find.
  PathOutcome find(AgentIndex agent, const PathQuery& query, const Limits& limits, Path& path);

  // The agent's best path when nobody else is there, and its cost.
  const Path& own_path(AgentIndex agent) const { return own_paths_[agent]; }
  Time own_cost(AgentIndex agent) const { return static_cast<Time>(own_paths_[agent].size()) - 1; }
  // The order in which that path visits the agent's stops.
  Sequence own_order(AgentIndex agent) const {
    return realized_sequence(*goals_[agent], own_paths_[agent]);
  }

  // The plan that `paths`, by AgentIndex, make.
  Plan plan(const std::vector<Path>& paths);

  std::int64_t calls() const { return calls_; }
  std::int64_t expanded() const { return low_level_.expanded(); }
  std::int64_t work() const { return expanded() + work::kPerCall * calls_; }

 private:
  FreeGoals& goals(AgentIndex agent);

  const Problem& problem_;
  AgentStopsStore& stops_;
  FreeLowLevelSearch low_level_;
  std::vector<std::unique_ptr<FreeGoals>> goals_;  // by AgentIndex
  std::vector<Path> own_paths_;                    // by AgentIndex
  std::int64_t calls_ = 0;
};

}  // namespace grove::detail
