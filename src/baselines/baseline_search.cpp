// SPDX-License-Identifier: MIT
#include "baselines/baseline_search.h"

#include <algorithm>
#include <stdexcept>

namespace grove::detail {

PathOutcome BaselineSearch::find(SequenceStages& goals, const PathQuery& query,
                                 const Limits& limits, Path& path) {
  const auto is_bar = [](const Constraint& c) { return c.kind == ConstraintKind::kVertexOrEdge; };
  if (!std::ranges::all_of(query.constraints, is_bar))
    throw std::invalid_argument("the low levels of other methods know no constraints but bars");
  if (query.reservations || goals.sequence_class() != SequenceClass())
    throw std::invalid_argument(
        "the low levels of other methods plan through all sequences, around constraints");
  if (limits.stop_requested()) return PathOutcome::kStopped;
  return search(goals.stops(), query, limits, path);
}

}  // namespace grove::detail
