// SPDX-License-Identifier: MIT
#include "tools/generate/map_generator.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "tools/generate/components.h"
#include "tools/generate/random.h"

namespace grove::detail {
namespace {

std::size_t cells_of(int width, int height) {
  return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
}

// --- random obstacles ---

bool touches_passable(const std::vector<bool>& passable, int width, int height, std::size_t cell) {
  const auto x = static_cast<int>(cell % width);
  const auto y = static_cast<int>(cell / width);
  return (x > 0 && passable[cell - 1]) || (x + 1 < width && passable[cell + 1]) ||
         (y > 0 && passable[cell - width]) || (y + 1 < height && passable[cell + width]);
}

// --- rooms ---

// The rooms along one axis. Room k spans the cells from first[k] to last[k]. A wall follows each
// room except the last one.
struct Spans {
  std::vector<int> first;
  std::vector<int> last;
  int count() const { return static_cast<int>(first.size()); }
};

Spans divide(int length, int room_size) {
  Spans spans;
  for (int begin = 0; begin < length; begin += room_size + 1) {
    spans.first.push_back(begin);
    spans.last.push_back(std::min(begin + room_size, length) - 1);
  }
  // Without a room after the last wall, that wall becomes part of the last room.
  if (spans.last.back() == length - 2) spans.last.back() = length - 1;
  return spans;
}

struct Wall {
  int room;        // rooms are numbered row by row
  int other_room;  // the room to the right of `room` or below it
  Position first;  // ends of the wall, without the cells where walls cross
  Position last;
};

std::vector<Wall> walls_between(const Spans& columns, const Spans& rows) {
  std::vector<Wall> walls;
  for (int j = 0; j < rows.count(); ++j) {
    for (int i = 0; i < columns.count(); ++i) {
      const int room = j * columns.count() + i;
      const int right = columns.last[i] + 1;
      const int below = rows.last[j] + 1;
      if (i + 1 < columns.count())
        walls.push_back({room, room + 1, {right, rows.first[j]}, {right, rows.last[j]}});
      if (j + 1 < rows.count())
        walls.push_back(
            {room, room + columns.count(), {columns.first[i], below}, {columns.last[i], below}});
    }
  }
  return walls;
}

// Moves a set of walls whose doors would connect all rooms to the front: a random spanning tree of
// the rooms (Kruskal 1956).
void connecting_walls_first(std::vector<Wall>& walls, int rooms) {
  std::vector<int> parent(rooms);
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int room) {
    while (parent[room] != room) room = parent[room] = parent[parent[room]];
    return room;
  };
  std::stable_partition(walls.begin(), walls.end(), [&](const Wall& wall) {
    const int a = root(wall.room);
    const int b = root(wall.other_room);
    parent[a] = b;
    return a != b;
  });
}

Position random_cell(const Wall& wall, Random& random) {
  const int length = wall.last.x - wall.first.x + wall.last.y - wall.first.y + 1;
  const auto step = random.below(length);
  const bool is_row = wall.first.y == wall.last.y && wall.first.x != wall.last.x;
  return is_row ? Position{wall.first.x + step, wall.first.y}
                : Position{wall.first.x, wall.first.y + step};
}

}  // namespace

Grid empty_map(int width, int height) {
  return Grid(width, height, std::vector<bool>(cells_of(width, height), true));
}

Grid random_map(int width, int height, double obstacles, std::uint64_t seed) {
  const std::size_t cells = cells_of(width, height);
  const auto wanted =
      static_cast<std::size_t>(std::llround(obstacles * static_cast<double>(cells)));
  if (wanted + 2 > cells)
    throw std::invalid_argument(fmt::format(
        "{} obstacles on {} cells leave fewer than 2 passable cells; expected at least 2", wanted,
        cells));

  Random random = random_for(RandomUse::kMap, seed);
  std::vector<std::size_t> order(cells);
  std::iota(order.begin(), order.end(), std::size_t{0});
  random.shuffle(order);
  std::vector<bool> passable(cells, true);
  for (std::size_t k = 0; k < wanted; ++k) passable[order[k]] = false;

  // Blocks the passable cells outside the largest component and frees as many blocked cells next to
  // it.
  const std::vector<Cell> kept = largest_component(Grid(width, height, passable));
  passable.assign(cells, false);
  for (Cell cell : kept) passable[cell] = true;
  std::size_t to_open = cells - wanted - kept.size();
  while (to_open > 0) {
    for (std::size_t cell : order) {
      if (to_open == 0) break;
      if (passable[cell] || !touches_passable(passable, width, height, cell)) continue;
      passable[cell] = true;
      --to_open;
    }
  }
  return Grid(width, height, passable);
}

Grid rooms_map(int width, int height, int room_size, double doors, std::uint64_t seed) {
  if (room_size < 1) throw std::invalid_argument("found a room size below 1; expected at least 1");
  const Spans columns = divide(width, room_size);
  const Spans rows = divide(height, room_size);
  std::vector<bool> passable(cells_of(width, height), false);
  const auto cell = [width](int x, int y) { return static_cast<std::size_t>(y) * width + x; };
  for (int j = 0; j < rows.count(); ++j)
    for (int i = 0; i < columns.count(); ++i)
      for (int y = rows.first[j]; y <= rows.last[j]; ++y)
        for (int x = columns.first[i]; x <= columns.last[i]; ++x) passable[cell(x, y)] = true;

  Random random = random_for(RandomUse::kMap, seed);
  std::vector<Wall> walls = walls_between(columns, rows);
  random.shuffle(walls);
  const int rooms = columns.count() * rows.count();
  connecting_walls_first(walls, rooms);
  const auto share = std::llround(doors * static_cast<double>(walls.size()));
  const auto door_count = static_cast<std::size_t>(std::max<long long>(share, rooms - 1));
  for (std::size_t k = 0; k < door_count; ++k) {
    const Position door = random_cell(walls[k], random);
    passable[cell(door.x, door.y)] = true;
  }
  return Grid(width, height, passable);
}

}  // namespace grove::detail
