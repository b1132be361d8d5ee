// SPDX-License-Identifier: MIT
// Minimum-spanning-tree heuristic for the baselines.
#pragma once

#include <vector>

#include "planning/sequence_stages.h"
#include "sequencing/stop_set_index.h"

namespace grove::detail {

// Weight of the minimum spanning tree of the goals that an agent has yet to visit, with shortest
// distances as edge weights. It is a lower bound on the remaining cost, because a path through all
// these goals contains a spanning tree. It is consistent, because a leg from i to j and the tree
// from j together span the goals of the tree from i. Caches the weight for every set of goals.
class SpanningTreeBound {
 public:
  static constexpr int kNowhere = -1;

  // `stops` must outlive this object.
  explicit SpanningTreeBound(const AgentStops& stops);

  // Weight of the tree over the stops `left`, the destination if there is one, and the stop `at`
  // unless it is kNowhere. Returns kNever if they cannot be connected.
  Time operator()(StopSet left, int at);

 private:
  Time tree(StopSet left, int at);
  Time distance(int from, int to) const;

  const AgentStops& stops_;
  const int destination_;            // index of the destination among the goals, or kNowhere
  std::vector<StopSetIndex> index_;  // by `at` + 1: indices into known_
  std::vector<Time> known_;
  std::vector<int> outside_;   // goals outside the tree
  std::vector<Time> nearest_;  // their distances to the tree
};

}  // namespace grove::detail
