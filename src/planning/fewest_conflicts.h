// SPDX-License-Identifier: MIT
// Selects, among all paths of one cost, one with the fewest conflicts with other agents.
#pragma once

#include <cstdint>
#include <vector>

#include "model/plan.h"
#include "planning/conflict_avoidance_table.h"
#include "planning/mdd.h"

namespace grove::detail {

// Breaks ties among the paths of an MDD, which have equal cost. One thread at a time. It keeps its
// workspace between calls, so reuse the object.
class FewestConflicts {
 public:
  // Writes a path of `paths` (not empty) with the fewest conflicts with `others`, as
  // ConflictAvoidanceTable::conflicts_of counts them. O(edges of `paths`), plus a few queries of
  // `others` per node.
  void find(const Mdd& paths, const ConflictAvoidanceTable& others, Path& path);

  // MDD nodes processed by all calls so far.
  std::int64_t nodes() const { return nodes_; }

 private:
  using NodeId = Mdd::NodeId;
  static constexpr NodeId kNoNode = -1;
  struct Best {
    std::int32_t conflicts;
    NodeId next;
  };

  Best best_step(const Mdd& paths, NodeId node, ConflictAvoidanceTable::Arrivals arrivals) const;

  std::vector<Best> best_;  // by node: the fewest conflicts from it to the end
  std::int64_t nodes_ = 0;
};

}  // namespace grove::detail
