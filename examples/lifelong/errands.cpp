// SPDX-License-Identifier: MIT
#include "errands.h"

#include <algorithm>
#include <random>
#include <utility>

namespace lifelong {
namespace {

std::vector<grove::Cell> passable_cells(const grove::World& world) {
  std::vector<grove::Cell> cells;
  for (int y = 0; y < world.height(); ++y)
    for (int x = 0; x < world.width(); ++x)
      if (world.passable({x, y})) cells.push_back({x, y});
  return cells;
}

// Returns a random number below `bound`. Does not use the distributions of the standard library,
// because their results differ between implementations.
std::size_t draw(std::mt19937_64& random, std::size_t bound) {
  return static_cast<std::size_t>(random() % bound);
}

}  // namespace

std::vector<Errand> random_errands(const grove::World& world, int count, int steps,
                                   std::uint64_t seed) {
  const std::vector<grove::Cell> cells = passable_cells(world);
  std::mt19937_64 random(seed);
  std::vector<Errand> errands;
  for (int i = 0; i < count; ++i) {
    const auto arrives = static_cast<int>(draw(random, static_cast<std::size_t>(steps)));
    errands.push_back({i, arrives, cells[draw(random, cells.size())]});
  }
  std::ranges::stable_sort(errands, {}, &Errand::arrives);
  return errands;
}

std::vector<grove::Cell> random_starts(const grove::World& world, int robots, std::uint64_t seed) {
  std::vector<grove::Cell> cells = passable_cells(world);
  std::mt19937_64 random(seed + 1);
  for (std::size_t left = cells.size(); left > 1; --left)
    std::swap(cells[left - 1], cells[draw(random, left)]);
  cells.resize(std::min(cells.size(), static_cast<std::size_t>(robots)));
  return cells;
}

}  // namespace lifelong
