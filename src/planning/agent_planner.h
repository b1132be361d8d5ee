// SPDX-License-Identifier: MIT
// Queries to a low level of CBS, and the interface of one that chooses the order of the tasks
// itself.
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

// Outcome of a query.
enum class PathOutcome : std::uint8_t {
  kFound,
  kAboveCutoff,  // proven: no path costs `cutoff` or less (there may be none at all)
  kInfeasible,   // proven: there is no path
  kStopped,  // nothing is proven: a limit or label_limit was reached, the costs to go would be too
             // large, or see known_sequences_only
};

// Constraints and preferences for the path of one agent. All pointers and spans must stay valid
// during the call.
struct PathQuery {
  static constexpr std::int64_t kUnlimited = std::numeric_limits<std::int64_t>::max();

  std::span<const Constraint> constraints = {};  // also satisfied while resting at the end
  // Among the paths of equal cost that the search generates, it prefers few conflicts with these;
  // null: no preference.
  const ConflictAvoidanceTable* others = nullptr;
  Time cutoff = kNever;  // paths of higher cost are of no use; kNever: any cost is accepted
  std::int64_t label_limit = kUnlimited;  // about this many labels, then kStopped

  // Paths that must be avoided, in place of constraints; null: none.
  const ReservationTable* reservations = nullptr;
  // Labels are popped in order of time + (1 + inflation_percent / 100) * cost to go. If it is not
  // 0, the path found may not be of least cost; proofs remain valid.
  int inflation_percent = 0;
  // Use only the sequences that the costs to go cover, at least one; kStopped if no path is found
  // because of that. Another sequence may have a cheaper path.
  bool known_sequences_only = false;
};

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
  // and satisfies the constraints of `query`, if that cost is at most the cutoff. The path ends
  // when the agent comes to rest: its cost is path.size() - 1. Writes `path` only on kFound. May
  // widen the costs to go of `goals`. Throws std::invalid_argument for a query that is invalid or
  // that this planner does not support.
  virtual PathOutcome find(SequenceStages& goals, const PathQuery& query, const Limits& limits,
                           Path& path) = 0;

  // Labels expanded by all calls so far.
  virtual std::int64_t expanded() const = 0;
};

}  // namespace grove::detail
