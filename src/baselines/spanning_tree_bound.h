// SPDX-License-Identifier: MIT
// Minimum-spanning-tree heuristic of the baselines.
#pragma once

#include <vector>

#include "planning/sequence_stages.h"
#include "sequencing/stop_set_index.h"

namespace grove::detail {

// Weight of the minimum spanning tree of the goals that an agent has yet to visit, by shortest
// distances. A lower bound, because a path through all of them contains a spanning tree.
// Consistent: a leg from i to j together with the tree from j spans what the tree from i spans.
// Caches the weight of every set.
class SpanningTreeBound {
 public:
  static constexpr int kNowhere = -1;

  // `stops` must outlive this.
  explicit SpanningTreeBound(const AgentStops& stops);

  // The tree over the stops `left`, the destination if there is one, and the stop `at` unless it is
  // kNowhere. Returns kNever if they cannot be connected.
  Time operator()(StopSet left, int at);

 private:
  Time tree(StopSet left, int at);
  Time distance(int from, int to) const;

  const AgentStops& stops_;
  const int destination_;  // number of the destination among the goals; kNowhere: there is none
  std::vector<StopSetIndex> index_;  // by `at` + 1: indices into known_
  std::vector<Time> known_;
  std::vector<int> outside_;  // goals outside the tree, and (nearest_) their distances to it
  std::vector<Time> nearest_;
};

}  // namespace grove::detail
