// SPDX-License-Identifier: MIT
#include "tests/planning/free_problems.h"

#include <algorithm>
#include <numeric>

#include "tests/planning/random_constraint.h"
#include "tests/support/instances.h"

namespace grove::testing {

Grid FreeProblems::grid() {
  if (conditional_ && below(3) > 0) return random_corridor_map(random_);
  switch (below(6)) {
    case 0:
      return grid_of({"......"});
    case 1:
      return grid_of({"@.@", "...", "@.@", "@.@"});
    case 2:
      return grid_of({"..@..", ".....", "..@.."});
    case 3:
      return grid_of({"....", ".@@.", "...."});
    default:
      break;
  }
  const int width = 1 + below(4);
  const int height = 1 + below(4);
  std::vector<bool> passable(static_cast<std::size_t>(width * height));
  for (std::size_t i = 0; i < passable.size(); ++i) passable[i] = below(5) > 0;
  passable[0] = true;
  return Grid(width, height, passable);
}

Cell FreeProblems::cell(const Grid& grid) {
  for (;;)
    if (const Cell cell = below(grid.cell_count()); grid.passable(cell)) return cell;
}

FreeProblem FreeProblems::problem(const Grid& grid) {
  FreeProblem problem{&grid, cell(grid), {}, {}, {}, {}};
  for (int n = below(6); n > 0; --n)
    if (const Cell stop = cell(grid); std::ranges::count(problem.stops, stop) == 0)
      problem.stops.push_back(stop);
  if (problem.stops.empty() || below(2) == 0) problem.destination = cell(grid);
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

Path FreeProblems::walk(const Grid& grid) {
  Path path{cell(grid)};
  for (int n = below(12); n > 0; --n) {
    const auto neighbors = grid.neighbors(path.back());
    const int choice = below(static_cast<int>(neighbors.size()) + 1);
    path.push_back(choice == 0 ? path.back() : neighbors[choice - 1]);
  }
  return path;
}

void FreeProblems::make_harder(FreeProblem& problem, const Path& path) {
  problem.constraints.push_back(constraint(problem, path));
  std::ranges::shuffle(problem.constraints, random_);
}

// Often on the path, often on a stop or the destination.
Constraint FreeProblems::constraint(const FreeProblem& problem, const Path& path) {
  std::vector<Cell> goals = problem.stops;
  if (problem.destination) goals.push_back(*problem.destination);
  if (conditional_ && below(2) == 0)
    return random_conditional_constraint(*problem.grid, path, goals, random_);
  Constraint c;
  const int at = below(static_cast<int>(path.size()));
  c.cell = path[at];
  c.begin = at;
  if (below(2) == 0) {
    c.cell = below(4) == 0 ? cell(*problem.grid) : goals[below(static_cast<int>(goals.size()))];
    c.begin = below(static_cast<int>(path.size()) + 6);
  }
  c.end = c.begin + (below(2) == 0 ? 0 : below(10));
  if (c.begin > 0 && below(8) == 0) c.end = kNever;
  if (below(3) == 0) {
    const auto neighbors = problem.grid->neighbors(c.cell);
    if (at > 0 && path[at - 1] != c.cell && c.cell == path[at])
      c.from = path[at - 1];
    else if (!neighbors.empty())
      c.from = neighbors[below(static_cast<int>(neighbors.size()))];
  }
  return c;
}

}  // namespace grove::testing
