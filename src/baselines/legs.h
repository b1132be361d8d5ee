// SPDX-License-Identifier: MIT
// From one goal to the next: the lower level of HCBS and MGCBS.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "model/limits.h"
#include "model/plan.h"
#include "planning/constraint.h"
#include "planning/safe_intervals.h"
#include "planning/sequence_stages.h"

namespace grove::detail {

// As many labels as their numbers can tell apart; who needs more throws std::bad_alloc, as one does
// who is refused memory.
inline constexpr std::size_t kMostLabels = std::numeric_limits<std::int32_t>::max();

// What one agent's legs take. Workspace of one thread.
class Legs {
 public:
  Legs() = default;
  Legs(const Legs&) = delete;
  Legs& operator=(const Legs&) = delete;
  virtual ~Legs() = default;

  // Turns to one agent and what is demanded of it. All are used until the next call.
  virtual void begin(const AgentStops& stops, const SafeIntervals& intervals,
                     std::span<const Constraint> constraints) = 0;

  // A safe interval of the cell of a goal: of a stop, or, with number stops.count(), of the
  // destination.
  struct Target {
    int goal;
    int slot;
  };
  // The first time from `time` on at which an agent that is on `from` at `time` can be in the
  // target, on whatever way; kNever: there is none, or a limit struck (which `limits` then says).
  virtual Time arrival(Cell from, Time time, Target target, const Limits& limits) = 0;

  // Appends where the agent is at time + 1, time + 2, ... on such a way. Only after arrival() has
  // found it, under the same constraints.
  virtual void append(Cell from, Time time, Target target, Path& path) = 0;

  // Labels expanded so far.
  virtual std::int64_t expanded() const = 0;
};

}  // namespace grove::detail
