// SPDX-License-Identifier: MIT
// Reference for single-agent search in a fixed order of goals: a slow search over all time steps.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "model/plan.h"
#include "planning/constraint.h"

namespace grove::detail::testing {

// One agent's problem. The goals include the destination.
struct Problem {
  const Grid* grid = nullptr;
  Cell start = kNoCell;
  std::vector<Cell> goals;
  std::vector<Constraint> constraints;
};

// The least cost of a path. Returns nullopt if there is no path. Computes the set of reachable
// states for each time, until all bounded constraints are over and the set no longer changes. An
// agent on its next goal may or may not count it as visited; this is the definition, not a pruning
// rule.
std::optional<Time> reference_cost(const Problem& problem);

// Describes why `path` does not solve the problem; empty if it does.
std::string path_error(const Problem& problem, const Path& path);

// The paths of other agents, without an index.
struct NaiveConflicts {
  std::vector<Path> paths;

  static Cell at(const Path& path, Time time);
  int conflicts(Cell from, Cell to, Time time) const;
  int conflicts_of_resting(Cell cell, Time time) const;
  // Conflicts of a whole path, including its rest at the end.
  int conflicts(const Path& path) const;
};

// The fewest conflicts of any path of exactly `cost`, which must be the cost of a cheapest path.
int reference_conflicts(const Problem& problem, const NaiveConflicts& others, Time cost);

}  // namespace grove::detail::testing
