// SPDX-License-Identifier: MIT
// What the low levels of published methods have in common: what they cannot do.
#pragma once

#include "planning/agent_planner.h"

namespace grove::detail {

class BaselineSearch : public AgentPlanner {
 public:
  PathOutcome find(SequenceStages& goals, const PathQuery& query, const Limits& limits,
                   Path& path) final;

 private:
  // A path through all of `stops`. The constraints are bars.
  virtual PathOutcome search(const AgentStops& stops, const PathQuery& query, const Limits& limits,
                             Path& path) = 0;
};

}  // namespace grove::detail
