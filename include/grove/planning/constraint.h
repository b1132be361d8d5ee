// SPDX-License-Identifier: MIT
// What a constraint-tree node forbids one agent.
#pragma once

#include "grove/model/grid.h"

namespace grove {

// Bars one agent from a cell, or from a move, during a range of times (CBS: Sharon et al. 2015;
// ranges as in Atzmon et al. 2020). Resting on a cell after the finish counts as being there.
struct Constraint {
  Cell cell = kNoCell;  // the cell barred; for a move, the cell it leads to
  Cell from =
      kNoCell;     // kNoCell: the cell itself is barred; else only moving from -> cell, never equal
  Time begin = 0;  // first and last time barred, inclusive; for a move the time of arrival
  Time end = 0;    // kNever: for ever

  bool is_move() const { return from != kNoCell; }
  friend bool operator==(const Constraint&, const Constraint&) = default;
};

}  // namespace grove
