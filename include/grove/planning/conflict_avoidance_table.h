// SPDX-License-Identifier: MIT
// Where the other agents are: the tie-breaker of the low level, never a constraint.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "grove/model/grid.h"
#include "grove/model/plan.h"

namespace grove {

// Counts, per cell and time and per move and time, the paths that use it. One per thread. Takes 5
// bytes per cell and time step of the longest path.
class ConflictAvoidanceTable {
 public:
  explicit ConflictAvoidanceTable(const Grid& grid);

  // A path that is empty (an agent not yet planned) adds nothing.
  void add(const Path& path);
  // `path` must have been added.
  void remove(const Path& path);
  // Removes every path. O(size of what was added).
  void clear();

  // Vertex and edge conflicts of arriving on `to` at time `time` coming from `from` (equal: a
  // wait).
  int conflicts(Cell from, Cell to, Time time) const {
    int count = 0;
    if (time < horizon_) {
      const Counts* now = counts_.data() + index(0, time);
      count = now[to].visits;
      if (from != to) count += now[from].moves[direction(to, from)];
    }
    return time > first_rest_[to] ? count + rests_before(to, time) : count;
  }
  // The same for waiting on `cell` from time `first` to time `last`, summed up.
  int conflicts_of_waiting(Cell cell, Time first, Time last) const;
  // How many times a path passes `cell` after `time`, or rests there (which counts once): what
  // resting there from `time` on would run into.
  int conflicts_of_resting(Cell cell, Time time) const;

 private:
  // The paths on a cell at a time, and those of them that just came from a neighbor, by direction.
  struct Counts {
    std::uint8_t visits = 0;
    std::array<std::uint8_t, 4> moves{};
  };

  std::size_t index(Cell cell, Time time) const {
    return static_cast<std::size_t>(time) * static_cast<std::size_t>(cells_) +
           static_cast<std::size_t>(cell);
  }
  static int direction(Cell from, Cell to) {
    const Cell delta = to - from;
    const bool along_row = delta == 1 || delta == -1;
    return 2 * static_cast<int>(along_row) + static_cast<int>(delta > 0);
  }
  int rests_before(Cell cell, Time time) const;
  void reserve(std::size_t steps);
  void remember_touched(std::size_t place);
  void forget_counts();

  Cell cells_;
  Time horizon_ = 0;            // times 0 .. horizon_ - 1 have counts; later there are only rests
  std::vector<Counts> counts_;  // by time, then cell

  // An agent that rests is not written into the counts: it would never end.
  std::vector<Time> first_rest_;          // by cell: when the first path comes to rest there
  std::vector<std::vector<Time>> rests_;  // by cell: when each path comes to rest there

  std::vector<std::size_t> touched_;  // places in counts_ to reset, unless there are too many
  bool touched_too_many_ = false;
  std::vector<Cell> rested_;  // the cells with a rest
};

}  // namespace grove
