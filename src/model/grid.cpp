// SPDX-License-Identifier: MIT
#include "model/grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace grove::detail {
namespace {

void require_valid_size(int width, int height, std::size_t cells) {
  if (width <= 0 || height <= 0 || width > std::numeric_limits<Cell>::max() / height)
    throw std::invalid_argument("a grid needs a positive width and height");
  if (cells != static_cast<std::size_t>(width) * static_cast<std::size_t>(height))
    throw std::invalid_argument("a grid needs width * height cells");
}

// Returns the moves from each cell, which lead to the adjacent passable cells. There are none from
// a blocked cell.
CsrArray moves_on(int width, int height, const std::vector<bool>& passable) {
  require_valid_size(width, height, passable.size());
  CsrArray moves;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const Cell here = y * width + x;
      const auto add = [&](bool is_there, Cell cell) {
        if (passable[here] && is_there && passable[cell]) moves.add(cell);
      };
      add(x + 1 < width, here + 1);
      add(y + 1 < height, here + width);
      add(x > 0, here - 1);
      add(y > 0, here - width);
      moves.end_row();
    }
  return moves;
}

}  // namespace

Grid::Grid(int width, int height, const std::vector<bool>& passable)
    : World(moves_on(width, height, passable), width),
      width_(width),
      height_(height),
      passable_count_(static_cast<int>(std::ranges::count(passable, true))),
      passable_(passable.begin(), passable.end()) {}

std::string Grid::name(State state) const {
  const Position p = position(place(state));
  return fmt::format("[{}, {}]", p.x, p.y);
}

}  // namespace grove::detail
