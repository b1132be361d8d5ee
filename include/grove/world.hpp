// SPDX-License-Identifier: MIT
/// \file
/// Worlds (grids of cells, or roadmaps of vertices and roads), places and poses.
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

/// A cell of a grid; (0, 0) is at the top left.
struct Cell {
  int x = 0;  ///< Column, from 0.
  int y = 0;  ///< Row, from 0; grows downwards.
  /// True if all members are equal.
  friend bool operator==(const Cell&, const Cell&) = default;
};

/// A vertex of a roadmap.
struct Vertex {
  std::string id = {};  ///< Id of the vertex.
  /// True if all members are equal.
  friend bool operator==(const Vertex&, const Vertex&) = default;
};

/// A place on a road between two vertices.
struct OnRoad {
  std::string from = {};  ///< Id of the vertex from which `steps` counts.
  std::string to = {};    ///< Id of the vertex at the other end.
  int steps = 0;  ///< Distance from `from` in time steps, from 1 to the length of the road - 1.
  /// Index in World::edges() of the road; required if several roads join the two vertices.
  std::optional<int> edge = std::nullopt;
  /// True if all members are equal. (The same place can be described from either end.)
  friend bool operator==(const OnRoad&, const OnRoad&) = default;
};

/// Place of an agent or a task: a Cell on a grid; a Vertex or an OnRoad on a roadmap.
using Place = std::variant<Cell, Vertex, OnRoad>;

/// Returns the place as in plan files, without an edge index: [3, 1], ["A"], ["A", "B", 2].
GROVE_API std::string to_string(const Place& place);

/// Direction in which a turning agent faces.
enum class Heading : std::uint8_t {
  north,  ///< Up: towards smaller y.
  east,   ///< Right: towards greater x.
  south,  ///< Down: towards greater y.
  west,   ///< Left: towards smaller x.
};

/// Place of an agent and, if the agent turns (Agent::turn_steps > 0), its heading.
struct Pose {
  Place place = {};                                  ///< Place.
  std::optional<Heading> heading = std::nullopt;     ///< Set only for agents that turn.
  std::optional<Heading> turning_to = std::nullopt;  ///< Within a quarter turn: its target heading.
  int turn_steps_done = 0;  ///< Time steps of that turn done so far; 0 outside a turn.
  /// True if all members are equal.
  friend bool operator==(const Pose&, const Pose&) = default;
};

/// A vertex of a roadmap and its position.
struct RoadmapVertex {
  std::string id = {};  ///< Unique among vertices; not empty.
  double x = 0;         ///< Metres; grows to the right.
  double y = 0;         ///< Metres; grows upwards.
};

/// A road between two vertices.
struct RoadmapEdge {
  std::string from = {};  ///< Id of the first vertex.
  std::string to = {};    ///< Id of the second vertex, different from the first.
  int steps = 1;          ///< Time steps to drive along the road, at least 1.
  bool one_way = false;   ///< True: only from `from` to `to`.
};

/// A grid or a roadmap. Immutable: any thread may read it. Copies are cheap, because they share the
/// data.
class GROVE_API World {
 public:
  /// Returns a grid. `passable` has width * height entries, row by row from the top. Throws
  /// InvalidArgument if the sizes are invalid or do not match.
  static World grid(int width, int height, const std::vector<bool>& passable);
  /// Returns a grid from rows of equal length, top row first. '.' and ' ' are passable; '@', '#',
  /// 'T', 'O' and 'W' are blocked. Throws InvalidArgument, with field() "/<i>" if row i is invalid.
  static World from_rows(const std::vector<std::string>& rows);
  /// Returns a roadmap of at least one vertex. Throws InvalidArgument for invalid vertices or
  /// roads.
  static World roadmap(std::vector<RoadmapVertex> vertices, std::vector<RoadmapEdge> edges);
  /// Reads a roadmap if the file name ends in `.json`, otherwise a Moving AI map. Throws
  /// InputError.
  static World read(const std::filesystem::path& path);

  bool is_grid() const;                         ///< False: a roadmap.
  int width() const;                            ///< Cells; 0 for roadmaps.
  int height() const;                           ///< Cells; 0 for roadmaps.
  bool passable(Cell cell) const;               ///< False outside the grid, and for roadmaps.
  std::vector<RoadmapVertex> vertices() const;  ///< Empty for grids.
  std::vector<RoadmapEdge> edges() const;       ///< Empty for grids.

 private:
  friend struct Access;
  struct Data;
  explicit World(std::shared_ptr<const Data> data) : data_(std::move(data)) {}
  std::shared_ptr<const Data> data_;
};

}  // namespace grove
