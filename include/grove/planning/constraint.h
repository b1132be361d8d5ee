// SPDX-License-Identifier: MIT
// What a constraint-tree node demands of one agent.
#pragma once

#include <cstdint>

#include "grove/model/grid.h"

namespace grove {

enum class ConstraintKind : std::uint8_t {
  // Not on `cell` (resting on it after the finish counts as being there), or, with `from` given,
  // not moving from -> cell, at any time in [begin, end]; for a move the time of arrival.
  kBar,
  // Does not come to rest for ever on `cell` at `end` or earlier: if the agent ends there, it
  // arrives there for the last time, by a move, later than `end`. (Target reasoning: Li et al.
  // 2021.) `from` and `begin` are not used.
  kNoRestBy,
  // Comes to rest for ever on `cell`, at `end` or earlier. `from` and `begin` are not used.
  kRestBy,
  // Does not leave a chain (chains.h) for its end `cell` by way of the inner cell `from`, arriving
  // at a time in [begin, end], after having entered it from its other end and stayed inside since.
  // Turning round inside, and starting inside, are no traversals.
  kNoTraversal,
  // Of the stops in the order in which they are counted, number `begin` (from 0) is the one on
  // `cell`, or is not. Such constraints make a sequence class (sequence_constraints.h).
  kStopIs,
  kStopIsNot,
};

// Bars are those of CBS (Sharon et al. 2015), ranges as in Atzmon et al. 2020. Times are inclusive.
struct Constraint {
  Cell cell = kNoCell;
  Cell from = kNoCell;
  Time begin = 0;
  Time end = 0;  // kNever: for ever
  ConstraintKind kind = ConstraintKind::kBar;

  bool is_move() const { return kind == ConstraintKind::kBar && from != kNoCell; }
  friend bool operator==(const Constraint&, const Constraint&) = default;
};

inline bool is_about_sequence(const Constraint& c) {
  return c.kind == ConstraintKind::kStopIs || c.kind == ConstraintKind::kStopIsNot;
}

}  // namespace grove
