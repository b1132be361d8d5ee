// SPDX-License-Identifier: MIT
// The grid that agents move on.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "grove/model/assert.h"

namespace grove {

// A cell of a grid as one number: y * width + x. Meaningful only together with its grid.
using Cell = std::int32_t;
inline constexpr Cell kNoCell = -1;

// A discrete time or a duration, in steps.
using Time = std::int32_t;
// No time at all: later than every time a plan can mention. Safe to add small durations to.
inline constexpr Time kNever = 1 << 30;

// Column x and row y; (0, 0) is the top left cell, y grows downwards.
struct Position {
  int x = 0;
  int y = 0;
  friend bool operator==(const Position&, const Position&) = default;
};

// A rectangular 4-connected grid of passable and blocked cells (docs/design.md, section 1).
// Immutable after construction, so any number of threads may read one.
class Grid {
 public:
  // `passable` holds width * height entries, row by row from the top.
  // Throws std::invalid_argument when a size is not positive or does not fit.
  Grid(int width, int height, const std::vector<bool>& passable);

  int width() const { return width_; }
  int height() const { return height_; }
  // All cells, passable or not: cells are numbered 0 .. cell_count() - 1.
  Cell cell_count() const { return width_ * height_; }
  int passable_count() const { return passable_count_; }

  bool contains(Position p) const { return p.x >= 0 && p.x < width_ && p.y >= 0 && p.y < height_; }
  bool passable(Cell cell) const { return passable_[cell] != 0; }
  Cell cell(Position p) const {
    GROVE_ASSERT(contains(p), "a position is on the grid");
    return p.y * width_ + p.x;
  }
  Position position(Cell cell) const { return {cell % width_, cell / width_}; }

  // The passable cells one move away from `cell` (up to 4; none for a blocked cell).
  std::span<const Cell> neighbors(Cell cell) const {
    return {neighbors_.data() + first_neighbor_[cell],
            neighbors_.data() + first_neighbor_[cell + 1]};
  }

 private:
  int width_;
  int height_;
  int passable_count_ = 0;
  std::vector<std::uint8_t> passable_;
  std::vector<std::int32_t> first_neighbor_;
  std::vector<Cell> neighbors_;
};

}  // namespace grove
