// SPDX-License-Identifier: MIT
// Corridors and doors: rows of cells in which an agent can only go on or turn round.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "grove/model/grid.h"

namespace grove {

// The chains of a grid: maximal rows of passable cells with exactly two passable neighbors, the
// *inner* cells, with the two *end* cells they join, which have fewer or more neighbors. A door
// between two rooms is a chain of two moves. The two ends may be one cell. A ring has no end and is
// no chain. Immutable after construction, so any number of threads may read one.
class Chains {
 public:
  static constexpr int kNoChain = -1;

  // O(cells).
  explicit Chains(const Grid& grid);

  int count() const { return static_cast<int>(first_.size()) - 1; }
  // Whose inner cell this is; kNoChain if of none.
  int chain_of(Cell cell) const { return chain_of_[cell]; }
  // An end, the inner cells in order, the other end: the *front* and the *back*.
  std::span<const Cell> cells(int chain) const {
    return {cells_.data() + first_[chain], cells_.data() + first_[chain + 1]};
  }
  // Where an inner cell is in cells(): 1 is next to the front.
  int position(Cell inner) const { return position_[inner]; }

 private:
  static constexpr int kSeen = -2;  // on a ring

  void add_chain_through(const Grid& grid, Cell inner);
  void number_inner_cells(int chain);

  std::vector<std::int32_t> chain_of_;  // by cell
  std::vector<std::int32_t> position_;  // by cell
  std::vector<Cell> cells_;             // chain after chain
  std::vector<std::int32_t> first_{0};  // by chain; one more for the end of the last
};

}  // namespace grove
