// SPDX-License-Identifier: MIT
// Problem: the low level prefers few conflicts among the paths that it generates, but it keeps only
// the earliest label per state, safe interval and stage. Therefore it does not consider all places
// where the agent could spend a delay.
//
// Method: dynamic programming over the MDD, which represents every path. The conflicts of a step
// depend only on its two places and its time. Therefore the fewest conflicts from a node to the end
// follow from those of the next layer, and the layers are processed from last to first. The table
// is queried once per node, for the paths on its place and for the paths that arrive there in the
// next step; all steps from the node use the answers.
#include "planning/fewest_conflicts.h"

#include <limits>

#include "model/assert.h"

namespace grove::detail {

void FewestConflicts::find(const Mdd& paths, const ConflictAvoidanceTable& others, Path& path) {
  GROVE_ASSERT(!paths.empty(), "there is a path to choose from");
  nodes_ += paths.node_count();
  const Time cost = paths.cost();
  best_.resize(static_cast<std::size_t>(paths.node_count()));
  for (Time time = cost; time >= 0; --time) {
    const auto layer = paths.layer(time);
    for (NodeId node = layer.first; node < layer.end; ++node) {
      const Place place = paths.place(node);
      Best& best = best_[node];
      if (time == cost)
        best = {others.conflicts_of_resting(place, time), kNoNode};
      else
        best = best_step(paths, node, others.arrivals(place, time + 1));
      if (time > 0) best.conflicts += others.vertex_conflicts(place, time);
    }
  }
  path.clear();
  const auto first = paths.layer(0);
  NodeId node = first.first;
  for (NodeId other = first.first; other < first.end; ++other)
    if (best_[other].conflicts < best_[node].conflicts) node = other;
  for (; node != kNoNode; node = best_[node].next) path.push_back(paths.state(node));
  GROVE_ASSERT(std::ssize(path) == cost + 1, "a path has a node in each layer of its MDD");
}

FewestConflicts::Best FewestConflicts::best_step(const Mdd& paths, NodeId node,
                                                 ConflictAvoidanceTable::Arrivals arrivals) const {
  Best best{std::numeric_limits<std::int32_t>::max(), kNoNode};
  for (const NodeId next : paths.successors(node)) {
    const Place to = paths.place(next);
    const int swaps = to == paths.place(node) ? 0 : arrivals.from(to);
    if (const std::int32_t conflicts = best_[next].conflicts + swaps; conflicts < best.conflicts)
      best = {conflicts, next};
  }
  GROVE_ASSERT(best.next != kNoNode, "a node before the last layer has a successor");
  return best;
}

}  // namespace grove::detail
