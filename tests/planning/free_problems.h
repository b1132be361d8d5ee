// SPDX-License-Identifier: MIT
// Random problems for the low levels that choose the order, on tiny maps.
#pragma once

#include <random>

#include "model/plan.h"
#include "tests/planning/free_reference.h"
#include "tests/planning/random_cases.h"

namespace grove::detail::testing {

// The seed settles what comes. `conditional`: constraints of all kinds, not bars alone.
class FreeProblems {
 public:
  FreeProblems(unsigned seed, bool conditional) : random_(seed), conditional_(conditional) {}

  // One of 0 .. bound - 1.
  int below(int bound) { return static_cast<int>(random_() % static_cast<unsigned>(bound)); }
  Grid grid();
  // Without constraints.
  FreeProblem problem(const Grid& grid);
  Path walk(const Grid& grid) { return random_walk(grid, random_); }
  // Adds a constraint that most likely matters to an agent that went `path`.
  void make_harder(FreeProblem& problem, const Path& path);

 private:
  SequenceClass sequence_class(int stops);
  Constraint constraint(const FreeProblem& problem, const Path& path);

  std::mt19937 random_;
  const bool conditional_;
};

}  // namespace grove::detail::testing
