// SPDX-License-Identifier: MIT
// Space-time step by step, as A* over (cell, time) sees it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "planning/constraint.h"
#include "planning/safe_intervals.h"

namespace grove::detail {

// How often the searches look at the limits: every tenth of a millisecond or so.
inline constexpr std::int64_t kExpansionsPerPoll = 512;

// From this time on nothing changes any more: a cell or a move is barred then and at every later
// time, or never again.
inline Time settled_from(std::span<const Constraint> constraints) {
  Time settled = 0;
  for (const Constraint& c : constraints)
    settled = std::max(settled, c.end < kNever ? c.end + 1 : c.begin);
  return settled;
}

// The slot of `cell` at `time`; -1: barred. Not with other constraints than bars.
inline int slot_at(const SafeIntervals& intervals, Cell cell, Time time) {
  if (intervals.unconstrained(cell)) return cell;
  for (int slot = intervals.first_slot(cell); slot < intervals.end_slot(cell); ++slot)
    if (intervals.begin_of(slot) <= time && time <= intervals.end_of(slot)) return slot;
  return -1;
}

// Calls reach(cell) for every cell where an agent that is on `from` at `time` may be one step
// later.
template <class Reach>
void for_each_step(const World& world, const SafeIntervals& intervals, Cell from, Time time,
                   Reach reach) {
  const int slot = slot_at(intervals, from, time);
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
