// SPDX-License-Identifier: MIT
// The low level prefers few conflicts among the ways it meets, but it keeps one label per safe
// interval and state, the earliest: where a delay could be spent elsewhere, it does not see that.
// The layered graph has every way, and a step's conflicts depend on its two cells and its time
// alone: so the fewest from each node to the end come from the layer after it, last layer first.
#include "grove/planning/fewest_conflicts.h"

#include <limits>

namespace grove {

void FewestConflicts::find(const OptimalPaths& paths, const ConflictAvoidanceTable& others,
                           Path& path) {
  nodes_ += paths.node_count();
  const Time cost = paths.cost();
  best_.resize(static_cast<std::size_t>(paths.node_count()));
  for (Time time = cost; time >= 0; --time) {
    const auto layer = paths.layer(time);
    for (OptimalPaths::NodeId node = layer.first; node < layer.end; ++node) {
      const Cell cell = paths.cell(node);
      Best best{std::numeric_limits<std::int32_t>::max(), -1};
      if (time == cost) best.conflicts = others.conflicts_of_resting(cell, time);
      for (const OptimalPaths::NodeId next : paths.successors(node)) {
        const std::int32_t conflicts =
            best_[next].conflicts + others.conflicts(cell, paths.cell(next), time + 1);
        if (conflicts < best.conflicts) best = {conflicts, next};
      }
      best_[node] = best;
    }
  }
  path.clear();
  const auto first = paths.layer(0);
  OptimalPaths::NodeId node = first.first;
  for (OptimalPaths::NodeId other = first.first; other < first.end; ++other)
    if (best_[other].conflicts < best_[node].conflicts) node = other;
  for (; node >= 0; node = best_[node].next) path.push_back(paths.cell(node));
}

}  // namespace grove
