// SPDX-License-Identifier: MIT
#include "tests/planning/free_problems.h"

#include <algorithm>
#include <numeric>

#include "tests/support/instances.h"

namespace grove::detail::testing {

Grid FreeProblems::grid() {
  return conditional_ && below(3) > 0 ? random_corridor_map(random_) : random_small_map(random_);
}

FreeProblem FreeProblems::problem(const Grid& grid) {
  FreeProblem problem{&grid, random_cell(grid, random_), {}, {}, {}, {}};
  for (int n = below(6); n > 0; --n)
    if (const Cell stop = random_cell(grid, random_); std::ranges::count(problem.stops, stop) == 0)
      problem.stops.push_back(stop);
  if (problem.stops.empty() || below(2) == 0) problem.destination = random_cell(grid, random_);
  problem.work = sequence_class(static_cast<int>(problem.stops.size()));
  return problem;
}

SequenceClass FreeProblems::sequence_class(int stops) {
  SequenceClass work;
  if (below(3) == 0) return work;
  Sequence order(static_cast<std::size_t>(stops));
  std::iota(order.begin(), order.end(), Stop{0});
  std::ranges::shuffle(order, random_);
  work.prefix.assign(order.begin(), order.begin() + below(below(2) == 0 ? stops + 1 : 1));
  for (int stop = 0; stop < stops; ++stop)
    if (below(3) == 0) work.forbidden_next |= StopSet{1} << stop;
  return work;
}

void FreeProblems::make_harder(FreeProblem& problem, const Path& path) {
  problem.constraints.push_back(constraint(problem, path));
  std::ranges::shuffle(problem.constraints, random_);
}

Constraint FreeProblems::constraint(const FreeProblem& problem, const Path& path) {
  std::vector<Cell> goals = problem.stops;
  if (problem.destination) goals.push_back(*problem.destination);
  if (conditional_ && below(2) == 0)
    return random_conditional_constraint(*problem.grid, path, goals, random_);
  return random_bar(*problem.grid, path, goals, random_);
}

}  // namespace grove::detail::testing
