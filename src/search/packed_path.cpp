// SPDX-License-Identifier: MIT
#include "grove/search/packed_path.h"

#include <algorithm>
#include <array>

namespace grove {
namespace {

constexpr std::uint32_t kMovesPerWord = 21;
constexpr int kBitsPerMove = 3;

std::size_t words_for(std::uint32_t steps) {
  return (steps + kMovesPerWord - 1) / kMovesPerWord;
}

// The cell offsets of the moves, by code. On a grid one column wide left and up are the same
// offset; either code gives back the same cell.
std::array<Cell, 5> offsets(const Grid& grid) {
  return {0, 1, grid.width(), -1, -grid.width()};
}

}  // namespace

PackedPath::PackedPath(const Grid& grid, const Path& path)
    : steps_(static_cast<std::uint32_t>(path.size() - 1)),
      words_(steps_ == 0 ? nullptr : std::make_unique<std::uint64_t[]>(words_for(steps_))) {
  const auto moves = offsets(grid);
  for (std::uint32_t step = 0; step < steps_; ++step) {
    const Cell offset = path[step + 1] - path[step];
    const auto code = static_cast<std::uint64_t>(std::ranges::find(moves, offset) - moves.begin());
    words_[step / kMovesPerWord] |= code << (step % kMovesPerWord * kBitsPerMove);
  }
}

void PackedPath::unpack(const Grid& grid, Cell start, Path& path) const {
  const auto moves = offsets(grid);
  path.resize(steps_ + 1);
  path[0] = start;
  Cell cell = start;
  std::uint64_t word = 0;
  for (std::uint32_t step = 0; step < steps_; ++step) {
    if (step % kMovesPerWord == 0) word = words_[step / kMovesPerWord];
    cell += moves[word & 7];
    word >>= kBitsPerMove;
    path[step + 1] = cell;
  }
}

std::size_t PackedPath::heap_bytes() const {
  return words_for(steps_) * sizeof(std::uint64_t);
}

}  // namespace grove
