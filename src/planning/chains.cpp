// SPDX-License-Identifier: MIT
#include "grove/planning/chains.h"

#include <algorithm>

namespace grove {
namespace {

bool is_inner(const Grid& grid, Cell cell) {
  return grid.neighbors(cell).size() == 2;
}

// Appends the cells from `next` to the end of the row, the neighbor `before` being behind. False,
// and nothing of worth appended, if that leads back to where it began.
bool walk_to_end(const Grid& grid, Cell before, Cell next, std::vector<Cell>& cells) {
  const Cell origin = before;
  while (next != origin) {
    cells.push_back(next);
    if (!is_inner(grid, next)) return true;
    const auto ways = grid.neighbors(next);
    const Cell after = ways[0] == before ? ways[1] : ways[0];
    before = next;
    next = after;
  }
  return false;
}

}  // namespace

Chains::Chains(const Grid& grid)
    : chain_of_(grid.cell_count(), kNoChain), position_(grid.cell_count(), 0) {
  for (Cell cell = 0; cell < grid.cell_count(); ++cell)
    if (is_inner(grid, cell) && position_[cell] == 0) add_chain_through(grid, cell);
}

void Chains::add_chain_through(const Grid& grid, Cell inner) {
  const auto begin = static_cast<std::ptrdiff_t>(cells_.size());
  const auto ways = grid.neighbors(inner);
  const bool ends = walk_to_end(grid, inner, ways[0], cells_);
  if (!ends) {  // a ring: its cells are in cells_, but for this one
    for (auto ring = cells_.begin() + begin; ring != cells_.end(); ++ring) position_[*ring] = kSeen;
    position_[inner] = kSeen;
    cells_.erase(cells_.begin() + begin, cells_.end());
    return;
  }
  std::reverse(cells_.begin() + begin, cells_.end());
  cells_.push_back(inner);
  walk_to_end(grid, inner, ways[1], cells_);
  first_.push_back(static_cast<std::int32_t>(cells_.size()));
  number_inner_cells(count() - 1);
}

void Chains::number_inner_cells(int chain) {
  const auto row = cells(chain);
  for (std::size_t i = 1; i + 1 < row.size(); ++i) {
    chain_of_[row[i]] = chain;
    position_[row[i]] = static_cast<std::int32_t>(i);
  }
}

}  // namespace grove
