// SPDX-License-Identifier: MIT
#include "grove/search/packed_path.h"

#include <algorithm>
#include <array>

#include "grove/model/assert.h"

namespace grove {
namespace {

constexpr std::uint32_t kMovesPerWord = 21;
constexpr int kBitsPerMove = 3;

// The cell offsets of the moves, by code. On a grid one column wide left and up are the same
// offset; either code gives back the same cell.
std::array<Cell, 5> offsets(const Grid& grid) {
  return {0, 1, grid.width(), -1, -grid.width()};
}

}  // namespace

std::size_t packed_words(std::uint32_t steps) {
  return (std::size_t{steps} + kMovesPerWord - 1) / kMovesPerWord;
}

void pack(const Grid& grid, const Path& path, std::uint64_t* words) {
  GROVE_ASSERT(!path.empty(), "an agent is somewhere");
  const auto moves = offsets(grid);
  for (std::uint32_t step = 0; step + 1 < path.size(); ++step) {
    if (step % kMovesPerWord == 0) words[step / kMovesPerWord] = 0;
    const Cell offset = path[step + 1] - path[step];
    const auto code = static_cast<std::uint64_t>(std::ranges::find(moves, offset) - moves.begin());
    GROVE_ASSERT(code < moves.size(), "a path makes at most one move each step");
    words[step / kMovesPerWord] |= code << (step % kMovesPerWord * kBitsPerMove);
  }
}

void PackedSteps::unpack(const Grid& grid, Cell start, Path& path) const {
  const auto moves = offsets(grid);
  path.resize(steps + 1);
  path[0] = start;
  Cell cell = start;
  std::uint64_t word = 0;
  for (std::uint32_t step = 0; step < steps; ++step) {
    if (step % kMovesPerWord == 0) word = words[step / kMovesPerWord];
    GROVE_ASSERT((word & 7) < moves.size(), "what is unpacked is a walk");
    cell += moves[word & 7];
    word >>= kBitsPerMove;
    path[step + 1] = cell;
  }
}

bool PackedSteps::is_walk(const Grid& grid, Cell start) const {
  const auto moves = offsets(grid);
  Cell cell = start;
  for (std::uint32_t step = 0; step < steps; ++step) {
    const std::uint64_t code =
        words[step / kMovesPerWord] >> (step % kMovesPerWord * kBitsPerMove) & 7;
    if (code >= moves.size()) return false;
    const Cell next = cell + moves[code];
    const auto neighbors = grid.neighbors(cell);
    if (next != cell && std::ranges::find(neighbors, next) == neighbors.end()) return false;
    cell = next;
  }
  return true;
}

}  // namespace grove
