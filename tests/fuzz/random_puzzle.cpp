// SPDX-License-Identifier: MIT
#include "tests/fuzz/random_puzzle.h"

#include <algorithm>
#include <string>
#include <vector>

#include "tests/fuzz/random.h"
#include "tests/fuzz/random_map.h"

namespace grove::detail::fuzz {
namespace {

constexpr int kSize = 7;  // maximum side of a board

// Grows the board cell by cell; a cell that closes a ring or widens a corridor is rarely added.
std::vector<std::string> corridors(int cells, Random& random) {
  std::vector<std::string> rows(kSize, std::string(kSize, '@'));
  rows[kSize / 2][kSize / 2] = '.';
  const int chance = random.between(5, 40);
  for (int count = 1; count < cells;) {
    const int x = random.below(kSize);
    const int y = random.below(kSize);
    const int around = passable_around(rows, x, y);
    if (rows[y][x] == '.' || around == 0 || (around > 1 && !random.percent(chance))) continue;
    rows[y][x] = '.';
    ++count;
  }
  return rows;
}

void shuffle(std::vector<Position>& cells, Random& random) {
  for (std::size_t i = cells.size(); i > 1; --i)
    std::swap(cells[i - 1], cells[static_cast<std::size_t>(random.below(static_cast<int>(i)))]);
}

}  // namespace

TinyInstance random_puzzle(std::uint64_t seed) {
  Random random(seed);
  const int agents = random.between(3, 5);
  TinyInstance puzzle;
  puzzle.rows = corridors(random.between(std::max(8, 2 * agents), 25), random);
  std::vector<Position> cells = passable_cells(puzzle.rows);
  const bool has_goals = random.percent(50);
  shuffle(cells, random);
  const std::vector<Position> starts(cells.begin(), cells.begin() + agents);
  shuffle(cells, random);
  for (int i = 0; i < agents; ++i) {
    TinyInstance::Agent agent{.start = starts[i], .goal = {}};
    if (has_goals) agent.goal = cells[i];
    puzzle.agents.push_back(agent);
  }
  const int tasks = random.between(1, 2);
  for (int i = 0; i < agents; ++i)
    for (int k = 0; k < tasks; ++k) puzzle.tasks.push_back({random.pick(cells), {i}, 0});
  return puzzle;
}

}  // namespace grove::detail::fuzz
