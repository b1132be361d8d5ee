// SPDX-License-Identifier: MIT
// What robots move on: a grid of cells, or vertices and roads; and how places are named.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "grove/export.hpp"

namespace grove {

// Column x and row y of a grid; (0, 0) is the top left cell, y grows downwards.
struct Cell {
  int x = 0;
  int y = 0;
  friend bool operator==(const Cell&, const Cell&) = default;
};

// Of a roadmap, by its id.
struct Vertex {
  std::string id = {};
  friend bool operator==(const Vertex&, const Vertex&) = default;
};

// `steps` from `from` on the road that the roadmap gives from there to `to`: 1 .. its length - 1.
// `edge`, its position in the roadmap, is needed where two roads join the same vertices.
struct OnRoad {
  std::string from = {};
  std::string to = {};
  int steps = 0;
  std::optional<int> edge = std::nullopt;
  friend bool operator==(const OnRoad&, const OnRoad&) = default;
};

using Place = std::variant<Cell, Vertex, OnRoad>;

// As plan files have it: [3, 1], ["A"], ["A", "B", 2].
GROVE_API std::string to_string(const Place& place);

// Where a robot looks; north is up, where y is smaller.
enum class Heading : std::uint8_t { north, east, south, west };

// Where a robot is, and where it looks if that matters.
struct Pose {
  Place place = {};
  std::optional<Heading> heading = std::nullopt;  // of robots that turn
  std::optional<Heading> turning_to =
      std::nullopt;  // within a quarter turn, after so many steps of it
  int turn_steps_done = 0;
  friend bool operator==(const Pose&, const Pose&) = default;
};

// Of a roadmap. `x` and `y` in metres, y up.
struct RoadmapVertex {
  std::string id = {};
  double x = 0;
  double y = 0;
};

// Takes `steps` >= 1 steps to drive.
struct RoadmapEdge {
  std::string from = {};
  std::string to = {};
  int steps = 1;
  bool one_way = false;
};

// Immutable and cheap to copy: copies share it, and what was computed for it. Any number of threads
// may use one.
class GROVE_API World {
 public:
  // `passable`: width * height cells, row by row from the top. Throws InvalidArgument.
  static World grid(int width, int height, const std::vector<bool>& passable);
  // Rows of one length, from the top: '.' and ' ' are passable, '@', '#', 'T', 'O' and 'W' blocked.
  // Throws InvalidArgument.
  static World from_rows(const std::vector<std::string>& rows);
  // Throws InvalidArgument.
  static World roadmap(std::vector<RoadmapVertex> vertices, std::vector<RoadmapEdge> edges);
  // A Moving AI map (*.map), or a roadmap (*.roadmap.json). Throws InputError.
  static World read(const std::filesystem::path& path);

  bool is_grid() const;
  int width() const;  // of a grid, in cells; else 0
  int height() const;
  bool passable(Cell cell) const;               // false outside, and on roadmaps
  std::vector<RoadmapVertex> vertices() const;  // of a roadmap; else none
  std::vector<RoadmapEdge> edges() const;

 private:
  friend struct Access;
  struct Data;
  explicit World(std::shared_ptr<const Data> data) : data_(std::move(data)) {}
  std::shared_ptr<const Data> data_;
};

}  // namespace grove
