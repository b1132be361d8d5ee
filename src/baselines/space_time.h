// SPDX-License-Identifier: MIT
// Successors in space-time, for A* over (cell, time).
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "model/assert.h"
#include "planning/constraint.h"
#include "planning/safe_intervals.h"

namespace grove::detail {

// Number of expansions between two checks of the limits: about a tenth of a millisecond.
inline constexpr std::int64_t kExpansionsPerPoll = 512;

// Returns a time from which on the constraints are constant: each cell and each move is then
// forbidden either at every later time or at none.
inline Time static_from(std::span<const Constraint> constraints) {
  Time static_time = 0;
  for (const Constraint& c : constraints)
    static_time = std::max(static_time, c.end < kNever ? c.end + 1 : c.begin);
  return static_time;
}

// Returns the slot of `cell` at `time`, or -1 if the cell is forbidden at that time. All
// constraints must be vertex or edge constraints.
inline int slot_at(const SafeIntervals& intervals, Cell cell, Time time) {
  if (intervals.unconstrained(cell)) return cell;
  for (int slot = intervals.first_slot(cell); slot < intervals.end_slot(cell); ++slot)
    if (intervals.begin_of(slot) <= time && time <= intervals.end_of(slot)) return slot;
  return -1;
}

// Calls reach(cell) for every cell that an agent on `from` at `time` can be on at `time` + 1.
template <class Reach>
void for_each_step(const World& world, const SafeIntervals& intervals, Cell from, Time time,
                   Reach reach) {
  const int slot = slot_at(intervals, from, time);
  GROVE_ASSERT(slot >= 0, "an agent is on a cell only while it is safe there");
  if (intervals.end_of(slot) > time) reach(from);
  for (Cell next : world.neighbors(from)) {
    if (intervals.unconstrained(next)) {
      reach(next);
      continue;
    }
    if (slot_at(intervals, next, time + 1) >= 0 &&
        intervals.first_move(slot, next, time + 1) == time + 1)
      reach(next);
  }
}

}  // namespace grove::detail
