// SPDX-License-Identifier: MIT
/// \file
/// What robots move on: a grid of cells, or vertices and roads; and how places are named.
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

/// A cell of a grid; (0, 0) is the top left one.
struct Cell {
  int x = 0;  ///< Column, from 0.
  int y = 0;  ///< Row, from 0; grows downwards.
  /// The same cell?
  friend bool operator==(const Cell&, const Cell&) = default;
};

/// A vertex of a roadmap.
struct Vertex {
  std::string id = {};  ///< Its id.
  /// The same vertex?
  friend bool operator==(const Vertex&, const Vertex&) = default;
};

/// A place on the road that the roadmap gives from one vertex to another.
struct OnRoad {
  std::string from = {};  ///< The id of the vertex that is counted from.
  std::string to = {};    ///< The id of the other one.
  int steps = 0;          ///< From `from`: 1 to the road's steps - 1.
  /// Its position in the roadmap, from 0: needed where two roads join the same vertices.
  std::optional<int> edge = std::nullopt;
  /// Named alike? (The same place may be named from either end.)
  friend bool operator==(const OnRoad&, const OnRoad&) = default;
};

/// Where a robot or a task may be: a Cell on a grid; a Vertex or OnRoad on a roadmap.
using Place = std::variant<Cell, Vertex, OnRoad>;

/// As plan files have it: [3, 1], ["A"], ["A", "B", 2].
GROVE_API std::string to_string(const Place& place);

/// Where a robot looks.
enum class Heading : std::uint8_t {
  north,  ///< Up, where y is smaller.
  east,   ///< To the right, where x is greater.
  south,  ///< Down.
  west,   ///< To the left.
};

/// Where a robot is, and where it looks if that matters.
struct Pose {
  Place place = {};                                  ///< Where it is.
  std::optional<Heading> heading = std::nullopt;     ///< Of robots that turn; else none.
  std::optional<Heading> turning_to = std::nullopt;  ///< Within a quarter turn: where to.
  int turn_steps_done = 0;                           ///< So many steps of that are done.
  /// The same place and heading?
  friend bool operator==(const Pose&, const Pose&) = default;
};

/// A vertex of a roadmap and where it lies.
struct RoadmapVertex {
  std::string id = {};  ///< Not empty; no other vertex has it.
  double x = 0;         ///< Metres, to the right.
  double y = 0;         ///< Metres, up.
};

/// A road.
struct RoadmapEdge {
  std::string from = {};  ///< The id of the vertex where it begins.
  std::string to = {};    ///< The id of the one where it ends, another one.
  int steps = 1;          ///< That it takes to drive, at least 1.
  bool one_way = false;   ///< From `from` to `to` alone?
};

/// What robots move on. Immutable and cheap to copy: copies share it, and what was computed for it.
/// Any number of threads may use one.
class GROVE_API World {
 public:
  /// A grid; `passable`: width * height cells, row by row from the top. Throws InvalidArgument.
  static World grid(int width, int height, const std::vector<bool>& passable);
  /// A grid as rows of one length, the top one first: dots and blanks are passable; '@', '#', 'T',
  /// 'O' and 'W' are blocked. Throws InvalidArgument.
  static World from_rows(const std::vector<std::string>& rows);
  /// Vertices, one at least, and the roads between them. Throws InvalidArgument.
  static World roadmap(std::vector<RoadmapVertex> vertices, std::vector<RoadmapEdge> edges);
  /// A Moving AI map (`*.map`), or a roadmap (`*.roadmap.json`). Throws InputError.
  static World read(const std::filesystem::path& path);

  bool is_grid() const;                         ///< Else it is a roadmap.
  int width() const;                            ///< Of a grid, in cells; else 0.
  int height() const;                           ///< Of a grid, in cells; else 0.
  bool passable(Cell cell) const;               ///< False outside, and on roadmaps.
  std::vector<RoadmapVertex> vertices() const;  ///< Of a roadmap; else none.
  std::vector<RoadmapEdge> edges() const;       ///< Of a roadmap; else none.

 private:
  friend struct Access;
  struct Data;
  explicit World(std::shared_ptr<const Data> data) : data_(std::move(data)) {}
  std::shared_ptr<const Data> data_;
};

}  // namespace grove
