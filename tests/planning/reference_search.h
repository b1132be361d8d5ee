// SPDX-License-Identifier: MIT
// What the low level must find, worked out the slow way: time step by time step.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "model/plan.h"
#include "planning/constraint.h"

namespace grove::detail::testing {

// One agent's problem in plain terms: the goals include the destination.
struct Problem {
  const Grid* grid = nullptr;
  Cell start = kNoCell;
  std::vector<Cell> goals;
  std::vector<Constraint> constraints;
};

// The cost of a cheapest path, none if there is no path. Reachable sets of states for each time,
// until every bounded constraint is over and nothing changes any more. An agent on its next goal
// may or may not count it as visited: the definition, not a rule.
std::optional<Time> reference_cost(const Problem& problem);

// What is wrong with `path` as a solution; empty if nothing.
std::string path_error(const Problem& problem, const Path& path);

// The paths of other agents, without an index.
struct NaiveConflicts {
  std::vector<Path> paths;

  static Cell at(const Path& path, Time time);
  int conflicts(Cell from, Cell to, Time time) const;
  int conflicts_of_resting(Cell cell, Time time) const;
  // Of a whole path and of resting at its end.
  int conflicts(const Path& path) const;
};

// The fewest conflicts of any path of exactly `cost`, which must be the cost of a cheapest path.
int reference_conflicts(const Problem& problem, const NaiveConflicts& others, Time cost);

}  // namespace grove::detail::testing
