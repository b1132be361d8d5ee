// SPDX-License-Identifier: MIT
// What single agents cost under one constraint more.
#pragma once

#include <cstdint>
#include <vector>

#include "model/limits.h"
#include "search/node_view.h"
#include "search/path_planner.h"
#include "search/result_cache.h"

namespace grove::detail {

// The prices of strong branching, which the memory keeps from node to node. Workspace of one
// thread.
class ChildCosts {
 public:
  enum class Outcome : std::uint8_t {
    kDone,
    kTooHard,  // it would take longer than a price is worth
    kStopped,  // a limit struck
  };

  // Both must outlive this. A split whose price takes more than `label_limit` is not considered.
  ChildCosts(PathPlanner& planner, WorkerCache& memory, std::int64_t label_limit)
      : planner_(planner), memory_(memory), most_labels_(label_limit) {}

  // By how much the costs of the agents in scope rise, each alone, when `demand` is made; if by
  // more than `slack`, kInfiniteCost.
  Outcome increase(NodeView& view, const AgentConstraint& demand, Cost slack, const Limits& limits,
                   Cost& increase);

  // What the agent costs under one constraint more; if that is above `cutoff`, anything above it.
  // kTooHard only if it takes more than `label_limit`.
  Outcome cost(NodeView& view, AgentIndex agent, const Constraint& more, Time cutoff,
               std::int64_t label_limit, const Limits& limits, Time& cost);

  // Calls of cost() so far, and those of them that the memory answered.
  std::int64_t asked() const { return asked_; }
  std::int64_t known() const { return known_; }

 private:
  PathPlanner& planner_;
  WorkerCache& memory_;
  const std::int64_t most_labels_;
  std::vector<AgentIndex> disturbed_;
  Path path_;
  std::int64_t asked_ = 0;
  std::int64_t known_ = 0;
};

// What an agent may cost if the sum of costs may rise by `slack`.
inline Time cutoff_for(const NodeView& view, AgentIndex agent, Cost slack) {
  return static_cast<Time>(std::min<Cost>(view.cost_of(agent) + slack, kNever - 1));
}

}  // namespace grove::detail
