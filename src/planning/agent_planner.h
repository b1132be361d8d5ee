// SPDX-License-Identifier: MIT
// Interface of a low level of CBS that chooses the order of the tasks itself.
#pragma once

#include <cstdint>

#include "model/limits.h"
#include "model/plan.h"
#include "planning/path_query.h"
#include "planning/sequence_stages.h"

namespace grove::detail {

// Interface of an exact single-agent planner. Grove's own is FreeOrderSipp; those of other methods
// are in the layer `baselines`. One thread at a time. An implementation keeps its workspace between
// calls, so reuse it.
class AgentPlanner {
 public:
  AgentPlanner() = default;
  AgentPlanner(const AgentPlanner&) = delete;
  AgentPlanner& operator=(const AgentPlanner&) = delete;
  virtual ~AgentPlanner() = default;

  // Finds a path of least cost from the start at time 0 that realizes some sequence of the class
  // and obeys the constraints of `query`, if that cost is at most the cutoff. The path ends when
  // the agent comes to rest: its cost is path.size() - 1. Writes `path` only on kFound. May widen
  // the costs to go of `goals`. Throws std::invalid_argument for a query that is invalid or that
  // this planner does not support.
  virtual PathOutcome find(SequenceStages& goals, const PathQuery& query, const Limits& limits,
                           Path& path) = 0;

  // Labels expanded by all calls so far.
  virtual std::int64_t expanded() const = 0;
};

}  // namespace grove::detail
