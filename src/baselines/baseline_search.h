// SPDX-License-Identifier: MIT
// Base class for the low levels of published methods, which rejects queries that they do not
// support.
#pragma once

#include <algorithm>
#include <stdexcept>

#include "planning/agent_planner.h"

namespace grove::detail {

class BaselineSearch : public AgentPlanner {
 public:
  PathOutcome find(SequenceStages& goals, const PathQuery& query, const Limits& limits,
                   Path& path) final {
    const auto is_bar = [](const Constraint& c) { return c.kind == ConstraintKind::kVertexOrEdge; };
    if (!std::ranges::all_of(query.constraints, is_bar))
      throw std::invalid_argument(
          "the low levels of published methods support only vertex and edge constraints");
    if (query.reservations || goals.sequence_class() != SequenceClass())
      throw std::invalid_argument(
          "the low levels of other methods plan through all sequences, around constraints");
    if (limits.stop_requested()) return PathOutcome::kStopped;
    return search(goals.stops(), query, limits, path);
  }

 private:
  // Finds a path through all of `stops`. All constraints are vertex or edge constraints.
  virtual PathOutcome search(const AgentStops& stops, const PathQuery& query, const Limits& limits,
                             Path& path) = 0;
};

}  // namespace grove::detail
