// SPDX-License-Identifier: MIT
// Reference for single-agent search with a fixed order of goals: a slow search over all time steps.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "model/plan.h"
#include "planning/constraint.h"

namespace grove::detail::testing {

// The problem of one agent. The goals include the destination.
struct Problem {
  const Grid* grid = nullptr;
  Cell start = kNoCell;
  std::vector<Cell> goals;
  std::vector<Constraint> constraints;
};

// Returns the least cost of a path, or nullopt if there is no path. Computes the set of reachable
// states for each time until all bounded constraints have ended and the set no longer changes. An
// agent on its next goal may or may not count it as visited. This choice follows the definition and
// prunes nothing.
std::optional<Time> reference_cost(const Problem& problem);

// Explains why `path` does not solve the problem, or "" if it does.
std::string path_error(const Problem& problem, const Path& path);

// The paths of other agents, without an index of their positions.
struct NaiveConflicts {
  std::vector<Path> paths;

  static Cell at(const Path& path, Time time);
  int conflicts(Cell from, Cell to, Time time) const;
  int conflicts_of_resting(Cell cell, Time time) const;
  // Returns the conflicts of a whole path, including its final rest.
  int conflicts(const Path& path) const;
};

// Returns the fewest conflicts of any path whose cost is `cost`, which must be the least cost.
int reference_conflicts(const Problem& problem, const NaiveConflicts& others, Time cost);

}  // namespace grove::detail::testing
