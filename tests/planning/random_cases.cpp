// SPDX-License-Identifier: MIT
#include "tests/planning/random_cases.h"

#include <algorithm>
#include <string>

#include "tests/planning/single_agent.h"
#include "tests/support/satisfies.h"

namespace grove::detail::testing {
namespace {

int below(std::mt19937& random, int bound) {
  return static_cast<int>(random() % static_cast<unsigned>(bound));
}

template <class T>
const T& any_of(const std::vector<T>& choices, std::mt19937& random) {
  return choices[below(random, static_cast<int>(choices.size()))];
}

std::vector<Mouth> mouths_of(const Grid& grid) {
  std::vector<Mouth> mouths;
  for (Cell end = 0; end < grid.cell_count(); ++end)
    for (Cell inner : grid.neighbors(end))
      if (is_mouth(grid, end, inner)) mouths.push_back({end, inner});
  return mouths;
}

// Returns a traversal constraint, often around a time at which `path` leaves a corridor. `mouths`
// must not be empty.
Constraint random_traversal(const Path& path, const std::vector<Mouth>& mouths,
                            std::mt19937& random) {
  const auto steps = static_cast<int>(path.size());
  Mouth mouth = any_of(mouths, random);
  Time t = below(random, steps + 4);
  for (Time left = 1; left < steps; ++left) {
    const Mouth way{path[left], path[left - 1]};
    if (std::ranges::count(mouths, way) == 0 || below(random, 2) == 0) continue;
    mouth = way;
    t = left;
  }
  const Time begin = std::max(0, t - below(random, 4));
  const Time end = below(random, 10) == 0 ? kNever : t + below(random, 5);
  return {mouth.end, mouth.inner, begin, end, ConstraintKind::kNoTraversal};
}

}  // namespace

Grid random_corridor_map(std::mt19937& random) {
  static const std::vector<std::vector<std::string>> maps = {
      {"..@..", ".....", "..@.."},           // a door
      {"..@@..", "......", "..@@.."},        // a longer door
      {"..@..", ".....", "..@..", "....."},  // two doors
      {"@.@@", "....", "@.@.", "@..."},      // a loop at a crossing
      {"......", "@.@@.@", "@....@"},        // a loop and a tail
      {".@.", "...", ".@."},                 // dead ends
      {".......", ".@@.@@.", "......."},     // three routes
      {"....", "@@@.", "...."},              // a snake
  };
  return grid_of(any_of(maps, random));
}

Grid random_small_map(std::mt19937& random) {
  switch (below(random, 6)) {
    case 0:
      return grid_of({"......"});  // a corridor
    case 1:
      return grid_of({"@.@", "...", "@.@", "@.@"});  // dead ends
    case 2:
      return grid_of({"..@..", ".....", "..@.."});  // a door
    case 3:
      return grid_of({"....", ".@@.", "...."});  // a ring
    default:
      break;
  }
  const int width = 1 + below(random, 4);
  const int height = 1 + below(random, 4);
  std::vector<bool> passable(static_cast<std::size_t>(width * height));
  for (std::size_t i = 0; i < passable.size(); ++i) passable[i] = below(random, 5) > 0;
  passable[0] = true;
  return Grid(width, height, passable);
}

Cell random_cell(const Grid& grid, std::mt19937& random) {
  for (;;)
    if (const Cell cell = below(random, grid.cell_count()); grid.passable(cell)) return cell;
}

Path random_walk(const Grid& grid, std::mt19937& random, int max) {
  return random_walk_from(random_cell(grid, random), grid, random, max);
}

Path random_walk_from(Cell start, const Grid& grid, std::mt19937& random, int max) {
  Path path{start};
  for (int n = below(random, max + 1); n > 0; --n) {
    const auto neighbors = grid.neighbors(path.back());
    const int choice = below(random, static_cast<int>(neighbors.size()) + 1);
    path.push_back(choice == 0 ? path.back() : neighbors[choice - 1]);
  }
  return path;
}

Constraint random_bar(const Grid& grid, const Path& path, const std::vector<Cell>& goals,
                      std::mt19937& random) {
  Constraint c;
  const int at = below(random, static_cast<int>(path.size()));
  c.cell = path[at];
  c.begin = at;
  if (below(random, 2) == 0) {
    c.cell = below(random, 4) == 0 ? random_cell(grid, random) : any_of(goals, random);
    c.begin = below(random, static_cast<int>(path.size()) + 6);
  }
  c.end = c.begin + (below(random, 2) == 0 ? 0 : below(random, 10));
  if (c.begin > 0 && below(random, 10) == 0) c.end = kNever;
  if (below(random, 3) > 0) return c;
  if (at > 0 && path[at - 1] != c.cell && c.cell == path[at])
    c.from = path[at - 1];
  else if (const auto neighbors = grid.neighbors(c.cell); !neighbors.empty())
    c.from = neighbors[below(random, static_cast<int>(neighbors.size()))];
  return c;
}

Constraint random_conditional_constraint(const Grid& grid, const Path& path,
                                         const std::vector<Cell>& goals, std::mt19937& random) {
  const auto cost = static_cast<Time>(path.size()) - 1;
  const std::vector<Mouth> mouths = mouths_of(grid);
  const int kind = below(random, 8);
  if (kind < 4 && !mouths.empty()) return random_traversal(path, mouths, random);
  if (kind < 7) {
    const Cell cell = below(random, 2) == 0 ? path.back() : any_of(goals, random);
    const Time end = below(random, 10) == 0 ? kNever : std::max(-1, cost - 2 + below(random, 6));
    return {cell, kNoCell, 0, end, ConstraintKind::kNoRestBy};
  }
  const Cell cell = below(random, 2) == 0 ? path.back() : any_of(goals, random);
  const Time end = below(random, 4) == 0 ? kNever : std::max(-1, cost - 1 + below(random, 9));
  return {cell, kNoCell, 0, end, ConstraintKind::kRestBy};
}

}  // namespace grove::detail::testing
