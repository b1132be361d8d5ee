// SPDX-License-Identifier: MIT
// Base class of the low levels of published methods. It rejects queries that they do not support.
#pragma once

#include "planning/agent_planner.h"

namespace grove::detail {

class BaselineSearch : public AgentPlanner {
 public:
  PathOutcome find(SequenceStages& goals, const PathQuery& query, const Limits& limits,
                   Path& path) final;

 private:
  // Finds a path through all of `stops`. All constraints are vertex or edge constraints.
  virtual PathOutcome search(const AgentStops& stops, const PathQuery& query, const Limits& limits,
                             Path& path) = 0;
};

}  // namespace grove::detail
