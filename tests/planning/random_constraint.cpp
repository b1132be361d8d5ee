// SPDX-License-Identifier: MIT
#include "tests/planning/random_constraint.h"

#include <algorithm>
#include <string>

#include "tests/planning/single_agent.h"
#include "tests/support/obeys.h"

namespace grove::testing {
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

// Around the times at which `path` leaves a chain, if it does.
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
      {"..@@..", "......", "..@@.."},        // a longer one
      {"..@..", ".....", "..@..", "....."},  // two doors
      {"@.@@", "....", "@.@.", "@..."},      // a loop at a crossing
      {"......", "@.@@.@", "@....@"},        // a loop and a tail
      {".@.", "...", ".@."},                 // dead ends
      {".......", ".@@.@@.", "......."},     // three ways
      {"....", "@@@.", "...."},              // a snake
  };
  return grid_of(any_of(maps, random));
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

}  // namespace grove::testing
