// SPDX-License-Identifier: MIT
// A grid of cells on which agents move.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/assert.h"
#include "model/world.h"

namespace grove::detail {

// The number of a cell: y * width + x. It is equal to the cell's Place, and to the State of an
// agent that turns freely there.
using Cell = Place;
inline constexpr Cell kNoCell = kNoPlace;

// Column x and row y. (0, 0) is the top left cell; y grows downwards.
struct Position {
  int x = 0;
  int y = 0;
  friend bool operator==(const Position&, const Position&) = default;
};

// A rectangular 4-connected grid of passable and blocked cells (docs/design.md, section 1).
// Immutable: any thread may read it.
class Grid : public World {
 public:
  // `passable` has width * height entries, row by row from the top. Throws std::invalid_argument if
  // width or height is not positive, their product exceeds the range of Cell, or the number of
  // entries is different.
  Grid(int width, int height, const std::vector<bool>& passable);

  int width() const { return width_; }
  int height() const { return height_; }
  // The number of cells, passable or not. Cells are numbered 0, ..., cell_count() - 1.
  Cell cell_count() const { return place_count(); }
  int passable_count() const { return passable_count_; }

  bool contains(Position p) const { return p.x >= 0 && p.x < width_ && p.y >= 0 && p.y < height_; }
  bool passable(Cell cell) const { return passable_[cell] != 0; }
  Cell cell(Position p) const {
    GROVE_ASSERT(contains(p), "a position is on the grid");
    return p.y * width_ + p.x;
  }
  Position position(Cell cell) const { return {cell % width_, cell / width_}; }
  std::string name(State state) const override;

 private:
  int width_;
  int height_;
  int passable_count_ = 0;
  std::vector<std::uint8_t> passable_;
};

}  // namespace grove::detail
