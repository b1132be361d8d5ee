// SPDX-License-Identifier: MIT
// Interface of a single-agent planner (low level of CBS) that chooses the order of the tasks
// itself, and the queries that it answers.
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "model/limits.h"
#include "model/plan.h"
#include "planning/conflict_avoidance_table.h"
#include "planning/constraint.h"
#include "planning/reservation_table.h"
#include "planning/sequence_stages.h"

namespace grove::detail {

// Outcome of a path query.
enum class PathOutcome : std::uint8_t {
  kFound,
  kAboveCutoff,  // proven: no path costs `cutoff` or less
  kInfeasible,   // proven: no path exists
  kStopped,  // nothing is proven: a limit of the run or label_limit was reached, the costs to go
             // would become too large, or known_sequences_only excluded sequences
};

// Constraints and preferences for the path of one agent. All pointers and spans must stay valid
// during the call.
struct PathQuery {
  static constexpr std::int64_t kUnlimited = std::numeric_limits<std::int64_t>::max();

  std::span<const Constraint> constraints = {};  // satisfied also by the final rest of the path
  // The search prefers paths with few conflicts with the paths in this table, among the paths of
  // equal cost that it generates; nullptr: no preference.
  const ConflictAvoidanceTable* others = nullptr;
  Time cutoff = kNever;                   // greatest useful cost of a path; kNever: no limit
  std::int64_t label_limit = kUnlimited;  // kStopped after about this many expanded labels

  // Paths that the path must not collide with; nullptr: none. If given, `constraints` is ignored.
  const ReservationTable* reservations = nullptr;
  // Percentage of the cost to go that is added to the f value by which labels are popped. If it is
  // not 0, the path found may cost more than the least cost; proofs remain valid.
  int inflation_percent = 0;
  // Restricts the search to the sequences that the costs to go cover. Another sequence may have a
  // cheaper path. If no covered sequence has a path, the outcome is kStopped unless all sequences
  // are covered.
  bool known_sequences_only = false;
};

// Interface of an exact single-agent planner. Grove's own search uses FreeOrderSipp; the layer
// `baselines` implements published planners. One thread at a time. An implementation keeps its
// workspace between calls, so reuse the object.
class AgentPlanner {
 public:
  AgentPlanner() = default;
  AgentPlanner(const AgentPlanner&) = delete;
  AgentPlanner& operator=(const AgentPlanner&) = delete;
  virtual ~AgentPlanner() = default;

  // Finds a path of least cost from the start at time 0 that realizes some sequence of the class
  // and satisfies the constraints of `query`, if that cost is at most the cutoff. With
  // inflation_percent or known_sequences_only the path may cost more than the least cost. The path
  // ends when the agent comes to rest: its cost is path.size() - 1. Writes `path` only on kFound.
  // May widen the costs to go of `goals` (CostToGo::extend). Throws std::invalid_argument for a
  // query that is invalid or that this planner does not support.
  virtual PathOutcome find(SequenceStages& goals, const PathQuery& query, const Limits& limits,
                           Path& path) = 0;

  // Labels expanded by all calls so far.
  virtual std::int64_t expanded() const = 0;
};

}  // namespace grove::detail
