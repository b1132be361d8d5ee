// SPDX-License-Identifier: MIT
// Interface of the leg planners of HCBS and MGCBS. A leg is a path from one goal to the next.
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

// Maximum number of labels of SpaceTimeLegs and of VisitingOrderSearch, because these labels have
// 32-bit numbers. A search that needs more throws std::bad_alloc, as if memory were exhausted.
inline constexpr std::size_t kMaxLabels = std::numeric_limits<std::int32_t>::max();

// Finds legs for one agent at a time. One thread at a time.
class Legs {
 public:
  Legs() = default;
  Legs(const Legs&) = delete;
  Legs& operator=(const Legs&) = delete;
  virtual ~Legs() = default;

  // Starts with an agent and its constraints. All arguments must stay valid until the next call of
  // begin().
  virtual void begin(const AgentStops& stops, const SafeIntervals& intervals,
                     std::span<const Constraint> constraints) = 0;

  // A safe interval of the cell of a goal. `goal`: index of a stop, or stops.count() for the
  // destination. `slot`: slot of the interval.
  struct Target {
    int goal;
    int slot;
  };
  // Returns the earliest time >= `time` at which an agent that is on `from` at `time` can be in the
  // target, over all paths. Returns kNever if it cannot, or if a limit was reached (then
  // limits.stop_requested()).
  virtual Time arrival(Cell from, Time time, Target target, const Limits& limits) = 0;

  // Appends the agent's cells at time + 1, time + 2, ..., arrival() on a path that arrives then.
  // Call it only after arrival() has found the leg, under the same constraints.
  virtual void append(Cell from, Time time, Target target, Path& path) = 0;

  // Number of labels expanded so far.
  virtual std::int64_t expanded() const = 0;
};

}  // namespace grove::detail
