// SPDX-License-Identifier: MIT
// How far an agent has to go at least: the heuristic of the baselines.
#pragma once

#include <vector>

#include "planning/sequence_stages.h"
#include "sequencing/sequence_dag.h"

namespace grove::detail {

// The least spanning tree of the goals that an agent has yet to visit, by shortest distances: a
// path through all of them is a spanning tree, so none is shorter. Consistent: a leg from i to j
// and the tree from j on span what the tree from i does. Remembers every set it was asked for.
class SpanningTreeBound {
 public:
  static constexpr int kNowhere = -1;

  // `stops` must outlive this.
  explicit SpanningTreeBound(const AgentStops& stops);

  // Over the stops `left`, the destination if there is one, and the stop `at` if it is one; kNever
  // if they cannot be connected.
  Time operator()(StopSet left, int at);

 private:
  Time tree(StopSet left, int at);
  Time distance(int from, int to) const;

  const AgentStops& stops_;
  const int destination_;            // its number among the goals; kNowhere: there is none
  std::vector<StopSetIndex> index_;  // by `at` + 1: into known_
  std::vector<Time> known_;
  std::vector<int> outside_;  // the tree, and how far each is from it
  std::vector<Time> nearest_;
};

}  // namespace grove::detail
