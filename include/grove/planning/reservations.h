// SPDX-License-Identifier: MIT
// Where planned agents are: what a further one must plan around.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "grove/model/grid.h"
#include "grove/model/instance.h"
#include "grove/model/plan.h"

namespace grove {

// The whole paths of some agents and their resting for ever, by cell: prioritised planning takes
// them for walls. Adding or removing a path costs what is on its cells, and the low level looks up
// only the cells it comes to. For one thread.
class Reservations {
 public:
  static constexpr AgentIndex kNobody = -1;

  // An agent's being on a cell without a break.
  struct Stay {
    Time first;        // from here
    Time last;         // to here, inclusive; kNever: it rests there
    Cell next;         // where it moves at last + 1; kNoCell when it rests
    AgentIndex agent;  // whose it is
  };

  explicit Reservations(const Grid& grid) : stays_(grid.cell_count()) {}

  // `path`, not empty, must collide with no path that is here; an agent has at most one.
  void add(AgentIndex agent, const Path& path);
  // `path` must have been added for this agent.
  void remove(AgentIndex agent, const Path& path);
  void clear();

  // The stays on a cell in order of time; they do not overlap.
  std::span<const Stay> stays(Cell cell) const { return stays_[cell]; }
  // How many there are on all cells.
  std::int64_t count() const { return count_; }
  // Who is on the cell at this time; kNobody.
  AgentIndex agent_at(Cell cell, Time time) const;

 private:
  std::vector<std::vector<Stay>> stays_;  // by cell
  std::int64_t count_ = 0;
};

}  // namespace grove
