// SPDX-License-Identifier: MIT
// Where the other agents are: the tie-breaker of the low level, never a constraint.
#pragma once

#include <cstdint>
#include <vector>

#include "grove/model/grid.h"
#include "grove/model/plan.h"

namespace grove {

// Counts, per cell and time and per move and time, the paths that use it. One per thread.
class ConflictAvoidanceTable {
 public:
  explicit ConflictAvoidanceTable(const Grid& grid);

  void add(const Path& path);
  // `path` must have been added.
  void remove(const Path& path);
  // Removes every path. O(size of what was added).
  void clear();

  // Vertex and edge conflicts of arriving on `to` at time `time` coming from `from` (equal: a
  // wait).
  int conflicts(Cell from, Cell to, Time time) const;
  // How many times a path passes `cell` after `time`, or rests there: what resting there from
  // `time` on would run into.
  int conflicts_of_resting(Cell cell, Time time) const;

  // (members: the implementer's)
};

}  // namespace grove
