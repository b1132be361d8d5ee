// SPDX-License-Identifier: MIT
// Low level of CBS with goals in a fixed order: a shortest path of one agent through its goals
// under constraints.
#pragma once

#include <cstdint>
#include <memory>

#include "model/limits.h"
#include "model/plan.h"
#include "planning/agent_planner.h"
#include "planning/goal_sequence.h"

namespace grove::detail {

// Safe-interval path planning (Phillips and Likhachev 2011) with one label per (state, safe
// interval, progress). The proofs are at the heads of safe_interval_search.h and
// fixed_order_goals.h. One thread at a time. It keeps its workspace between calls, so reuse the
// object.
class FixedOrderSipp {
 public:
  // `world` must outlive this object.
  explicit FixedOrderSipp(const World& world);
  ~FixedOrderSipp();

  // Finds a path of least cost from goals.start() at time 0 that visits the goals in order and
  // satisfies the constraints of `query`, if that cost is at most the cutoff. The path ends when
  // the agent comes to rest: its cost is path.size() - 1. Writes `path` only on kFound. Ignores
  // inflation_percent and known_sequences_only. With reservations and a cutoff, kAboveCutoff can
  // also mean that there is no path. Throws std::invalid_argument for more than 255 goals, and for
  // constraints that SafeIntervals::assign() refuses.
  PathOutcome find(const GoalSequence& goals, const PathQuery& query, const Limits& limits,
                   Path& path);

  // Labels expanded by all calls so far.
  std::int64_t expanded() const;

 private:
  class Workspace;
  std::unique_ptr<Workspace> workspace_;
};

}  // namespace grove::detail
