// SPDX-License-Identifier: MIT
// The low level of CBS: a shortest path of one agent through its goals under constraints.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "grove/model/limits.h"
#include "grove/model/plan.h"
#include "grove/planning/conflict_avoidance_table.h"
#include "grove/planning/constraint.h"
#include "grove/planning/goal_sequence.h"

namespace grove {

// Safe-interval path planning (Phillips and Likhachev 2011) with one label per (cell, safe
// interval, progress). The essay with the proof is at the head of low_level_search.cpp. Holds the
// workspace of one thread: reuse it, do not share it.
class LowLevelSearch {
 public:
  enum class Outcome : std::uint8_t {
    kFound,
    kInfeasible,  // proven: no path satisfies the constraints
    kStopped,     // a limit struck: nothing is known
  };

  // `grid` must outlive this.
  explicit LowLevelSearch(const Grid& grid);
  ~LowLevelSearch();

  // Finds a path of least cost from goals.start() at time 0 that visits the goals in order, obeys
  // `constraints` (also while resting at the end) and, among equally cheap ways met, prefers few
  // conflicts with `others` (may be null). The path ends when the agent comes to rest: its cost is
  // path.size() - 1. Writes `path` only on kFound.
  Outcome find(const GoalSequence& goals, std::span<const Constraint> constraints,
               const ConflictAvoidanceTable* others, const Limits& limits, Path& path);

  // Labels expanded by all calls so far.
  std::int64_t expanded() const;

 private:
  class Workspace;
  std::unique_ptr<Workspace> workspace_;
};

}  // namespace grove
