// SPDX-License-Identifier: MIT
// Random problems on tiny maps for single-agent searches that choose the order of the stops.
#pragma once

#include <random>

#include "model/plan.h"
#include "tests/planning/free_reference.h"
#include "tests/planning/random_cases.h"

namespace grove::detail::testing {

// Generates problems that depend only on the seed and the calls. `conditional`: uses constraints of
// all kinds on the path, not only vertex and edge constraints.
class FreeProblems {
 public:
  FreeProblems(unsigned seed, bool conditional) : random_(seed), conditional_(conditional) {}

  // Returns a random number from 0 to bound - 1.
  int below(int bound) { return static_cast<int>(random_() % static_cast<unsigned>(bound)); }
  Grid grid();
  // Returns a problem without constraints. It refers to `grid`.
  FreeProblem problem(const Grid& grid);
  Path walk(const Grid& grid) { return random_walk(grid, random_); }
  // Adds a constraint that `path` is likely to violate.
  void make_harder(FreeProblem& problem, const Path& path);

 private:
  SequenceClass sequence_class(int stops);
  Constraint constraint(const FreeProblem& problem, const Path& path);

  std::mt19937 random_;
  const bool conditional_;
};

}  // namespace grove::detail::testing
