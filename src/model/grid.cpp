// SPDX-License-Identifier: MIT
#include "grove/model/grid.h"

#include <limits>
#include <stdexcept>

namespace grove {
namespace {

void require_valid_size(int width, int height, std::size_t cells) {
  if (width <= 0 || height <= 0 || width > std::numeric_limits<Cell>::max() / height)
    throw std::invalid_argument("a grid needs a positive width and height");
  if (cells != static_cast<std::size_t>(width) * static_cast<std::size_t>(height))
    throw std::invalid_argument("a grid needs width * height cells");
}

}  // namespace

Grid::Grid(int width, int height, const std::vector<bool>& passable)
    : width_(width), height_(height), passable_(passable.begin(), passable.end()) {
  require_valid_size(width, height, passable.size());
  first_neighbor_.reserve(passable_.size() + 1);
  constexpr Position kMoves[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  for (Cell c = 0; c < cell_count(); ++c) {
    first_neighbor_.push_back(static_cast<std::int32_t>(neighbors_.size()));
    if (!passable_[c]) continue;
    ++passable_count_;
    for (Position move : kMoves) {
      const Position from = position(c);
      const Position to{from.x + move.x, from.y + move.y};
      if (contains(to) && passable_[cell(to)]) neighbors_.push_back(cell(to));
    }
  }
  first_neighbor_.push_back(static_cast<std::int32_t>(neighbors_.size()));
}

}  // namespace grove
