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

// Computes the cost increase of a branch for strong branching. The costs of single agents are
// cached from node to node. One thread at a time.
class ChildCosts {
 public:
  enum class Outcome : std::uint8_t {
    kDone,
    kTooHard,  // the label limit was reached, by this call or by an earlier call on the same
               // subproblem
    kStopped,  // a limit was reached
  };

  // `planner` and `memory` must outlive this object. `label_limit` is the label limit of each low
  // level call of increase(); a split that needs more labels is not considered.
  ChildCosts(PathPlanner& planner, WorkerCache& memory, std::int64_t label_limit)
      : planner_(planner), memory_(memory), label_limit_(label_limit) {}

  // Computes by how much the individual costs of the agents in scope rise in total if `constraint`
  // is added; kInfiniteCost if by more than `slack`.
  Outcome increase(NodeView& view, const AgentConstraint& constraint, Cost slack,
                   const Limits& limits, Cost& increase);

  // Computes the cost of the agent under the additional constraint `more`. If it is above `cutoff`,
  // returns some value above `cutoff`. kTooHard only if the computation takes more than
  // `label_limit` labels.
  Outcome cost(NodeView& view, AgentIndex agent, const Constraint& more, Time cutoff,
               std::int64_t label_limit, const Limits& limits, Time& cost);

  // Number of calls of cost(), and of those answered from the cache.
  std::int64_t asked() const { return asked_; }
  std::int64_t known() const { return known_; }

 private:
  PathPlanner& planner_;
  WorkerCache& memory_;
  const std::int64_t label_limit_;
  std::vector<AgentIndex> disturbed_;
  Path path_;
  std::int64_t asked_ = 0;
  std::int64_t known_ = 0;
};

// The max cost of an agent if the sum of costs may rise by `slack`.
inline Time cutoff_for(const NodeView& view, AgentIndex agent, Cost slack) {
  return static_cast<Time>(std::min<Cost>(view.cost_of(agent) + slack, kNever - 1));
}

}  // namespace grove::detail
