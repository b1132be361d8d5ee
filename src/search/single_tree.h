// SPDX-License-Identifier: MIT
// Forest for policy `free`: one tree for all sequences.
#pragma once

#include <deque>
#include <memory>
#include <vector>

#include "model/limits.h"
#include "planning/agent_planner.h"
#include "planning/agent_stops_cache.h"
#include "search/forest.h"

namespace grove::detail {

// A forest of one tree that fixes nothing. The sequence class of each agent has an empty prefix, so
// it contains every sequence, and the low level chooses among them. The tree holds every plan.
class SingleTree : public Forest {
 public:
  // All references must outlive this object. `stops` may be shared with other objects of the same
  // thread. `planner` plans the root's paths; nullptr: Grove's own low level.
  SingleTree(const Problem& problem, AgentStopsCache& stops, NodePool& pool, const Limits& limits,
             std::unique_ptr<AgentPlanner> planner = nullptr);

  Cost next_bound() const override { return tree_.empty() ? relaxed_bound_ : kInfiniteCost; }
  NodePtr next_root() override;
  std::int64_t rtsp_calls() const override { return 0; }

 private:
  const Problem& problem_;
  AgentStopsCache& stops_;
  NodePool& pool_;
  const Limits& limits_;
  std::unique_ptr<AgentPlanner> planner_;  // nullptr once the root exists
  Cost relaxed_bound_ = 0;                 // sum of the agents' relaxation bounds
  std::deque<Tree> tree_;                  // at most one
};

}  // namespace grove::detail
