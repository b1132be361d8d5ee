// SPDX-License-Identifier: MIT
#include "examples/lifelong/errands.h"

#include <algorithm>

#include "grove/detail/model/random.h"

namespace grove::detail::lifelong {
namespace {

std::vector<Cell> passable_cells(const Grid& grid) {
  std::vector<Cell> cells;
  for (Cell cell = 0; cell < grid.cell_count(); ++cell)
    if (grid.passable(cell)) cells.push_back(cell);
  return cells;
}

}  // namespace

std::vector<Errand> random_errands(const Grid& grid, int count, Time steps, std::uint64_t seed) {
  const std::vector<Cell> cells = passable_cells(grid);
  Random random(seed, 1);
  std::vector<Errand> errands;
  for (int i = 0; i < count; ++i)
    errands.push_back(
        {i, static_cast<Time>(random.below(steps)), cells[random.below(cells.size())]});
  std::ranges::stable_sort(errands, {}, &Errand::arrives);
  return errands;
}

std::vector<Cell> random_starts(const Grid& grid, int robots, std::uint64_t seed) {
  std::vector<Cell> cells = passable_cells(grid);
  Random(seed, 2).shuffle(cells);
  cells.resize(std::min(cells.size(), static_cast<std::size_t>(robots)));
  return cells;
}

}  // namespace grove::detail::lifelong
