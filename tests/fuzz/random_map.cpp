// SPDX-License-Identifier: MIT
#include "tests/fuzz/random_map.h"

#include <algorithm>

namespace grove::detail::fuzz {

int passable_around(const std::vector<std::string>& rows, int x, int y) {
  const auto open = [&](int cx, int cy) {
    return cy >= 0 && cy < static_cast<int>(rows.size()) && cx >= 0 &&
           cx < static_cast<int>(rows[cy].size()) && rows[cy][cx] == '.';
  };
  return open(x + 1, y) + open(x - 1, y) + open(x, y + 1) + open(x, y - 1);
}

namespace {

using Rows = std::vector<std::string>;

Rows filled(int width, int height, char c) {
  return Rows(static_cast<std::size_t>(height), std::string(static_cast<std::size_t>(width), c));
}

Rows open_map(Random& random) {
  const int width = random.between(2, 4);
  return filled(width, random.between(2, 12 / width), '.');
}

Rows obstacles(Random& random) {
  Rows rows = filled(random.between(3, 4), random.between(3, 4), '.');
  for (auto& row : rows)
    for (char& c : row)
      if (random.percent(25)) c = '@';
  for (char& c : rows[random.below(static_cast<int>(rows.size()))]) c = '.';
  return rows;
}

// A corridor in the middle row with side branches of up to `depth` cells, each on a random side.
Rows comb(int length, int depth, int branches, Random& random) {
  Rows rows = filled(length, 2 * depth + 1, '@');
  rows[depth] = std::string(static_cast<std::size_t>(length), '.');
  for (int b = 0; b < branches; ++b) {
    const int x = random.below(length);
    const int side = random.percent(50) ? 1 : -1;
    const int reach = random.between(1, depth);
    for (int d = 1; d <= reach; ++d) rows[depth + side * d][x] = '.';
  }
  return rows;
}

Rows rooms(Random& random) {
  const int height = random.between(2, 3);
  const int left = random.between(1, 2);
  const int right = random.between(1, 2);
  Rows rows = filled(left + 1 + right, height, '.');
  for (auto& row : rows) row[left] = '@';
  rows[random.below(height)][left] = '.';
  return rows;
}

// Grows a tree: each new cell is adjacent to exactly one cell of the tree.
Rows tree(Random& random) {
  constexpr int kSize = 4;
  Rows rows = filled(kSize, kSize, '@');
  rows[random.below(kSize)][random.below(kSize)] = '.';
  const int tries = random.between(20, 60);
  for (int k = 0; k < tries; ++k) {
    const int x = random.below(kSize);
    const int y = random.below(kSize);
    if (passable_around(rows, x, y) == 1) rows[y][x] = '.';
  }
  return rows;
}

Rows ring(Random& random) {
  const int width = random.between(3, 4);
  const int height = random.between(3, 4);
  Rows rows = filled(width, height + 1, '.');
  for (int y = 1; y < height - 1; ++y)
    for (int x = 1; x < width - 1; ++x) rows[y][x] = '@';
  std::fill(rows[height].begin(), rows[height].end(), '@');
  if (random.percent(50)) rows[height][random.below(width)] = '.';
  return rows;
}

Rows two_parts(Random& random) {
  const int height = random.between(2, 3);
  Rows rows = filled(random.between(4, 5), height, '.');
  const int wall = random.between(1, static_cast<int>(rows[0].size()) - 2);
  for (auto& row : rows) row[wall] = '@';
  return rows;
}

Rows drawn(Shape shape, Random& random) {
  switch (shape) {
    case Shape::kOpen:
      return open_map(random);
    case Shape::kObstacles:
      return obstacles(random);
    case Shape::kCorridor:
      return filled(random.between(4, 8), 1, '.');
    case Shape::kBays:
      return comb(random.between(3, 7), 1, random.between(1, 3), random);
    case Shape::kDeadEnds:
      return comb(random.between(3, 5), 2, random.between(1, 3), random);
    case Shape::kRooms:
      return rooms(random);
    case Shape::kTree:
      return tree(random);
    case Shape::kRing:
      return ring(random);
    case Shape::kTwoParts:
      return two_parts(random);
  }
  return open_map(random);
}

Rows turned(const Rows& rows) {
  Rows result = filled(static_cast<int>(rows.size()), static_cast<int>(rows[0].size()), '@');
  for (std::size_t y = 0; y < rows.size(); ++y)
    for (std::size_t x = 0; x < rows[y].size(); ++x) result[x][y] = rows[y][x];
  return result;
}

int passable_count(const Rows& rows) {
  int count = 0;
  for (const auto& row : rows) count += static_cast<int>(std::ranges::count(row, '.'));
  return count;
}

}  // namespace

std::vector<std::string> random_map(Shape shape, Random& random) {
  Rows rows;
  do {
    rows = drawn(shape, random);
  } while (passable_count(rows) < 4 || passable_count(rows) > 14);
  return random.percent(50) ? turned(rows) : rows;
}

}  // namespace grove::detail::fuzz
