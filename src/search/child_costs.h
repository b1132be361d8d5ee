// SPDX-License-Identifier: MIT
// Costs of single agents under one additional constraint, for strong branching.
#pragma once

#include <cstdint>
#include <vector>

#include "model/limits.h"
#include "search/node_view.h"
#include "search/path_planner.h"
#include "search/result_cache.h"

namespace grove::detail {

// Computes the cost increases of branches for strong branching. Caches the costs of single agents
// from node to node. One thread at a time.
class ChildCosts {
 public:
  enum class Outcome : std::uint8_t {
    kDone,
    kTooHard,  // the low level gave no result within the label limit or the size limit of its
               // tables, in this call or in an earlier call for the same subproblem
    kStopped,  // a limit was reached
  };

  // `planner` and `memory` must outlive this object. `label_limit` is the label limit of each
  // low-level call that increase() makes; strong branching does not consider a split that needs
  // more.
  ChildCosts(PathPlanner& planner, WorkerCache& memory, std::int64_t label_limit)
      : planner_(planner), memory_(memory), label_limit_(label_limit) {}

  // Sets `increase` to the total by which the individual costs of the agents in scope rise if
  // `constraint` is added, or to kInfiniteCost if that exceeds `slack`. `increase` is valid only if
  // the result is kDone.
  Outcome increase(NodeView& view, const AgentConstraint& constraint, Cost slack,
                   const Limits& limits, Cost& increase);

  // Sets `cost` to the cost of the agent under its constraints at the node and `more`, or to some
  // value above `cutoff` if the cost is above `cutoff`. Sets it only if the result is kDone. With
  // PathQuery::kUnlimited it ignores that an earlier call was too hard.
  Outcome cost(NodeView& view, AgentIndex agent, const Constraint& more, Time cutoff,
               std::int64_t label_limit, const Limits& limits, Time& cost);

  // Number of calls of cost(), and number of those that the cache answered.
  std::int64_t asked() const { return asked_; }
  std::int64_t known() const { return known_; }

 private:
  PathPlanner& planner_;
  WorkerCache& memory_;
  const std::int64_t label_limit_;
  std::vector<AgentIndex> affected_;
  Path path_;
  std::int64_t asked_ = 0;
  std::int64_t known_ = 0;
};

// The greatest cost that an agent may have if the sum of costs may rise by at most `slack`; at most
// kNever - 1.
inline Time cutoff_for(const NodeView& view, AgentIndex agent, Cost slack) {
  return static_cast<Time>(std::min<Cost>(view.cost_of(agent) + slack, kNever - 1));
}

}  // namespace grove::detail
