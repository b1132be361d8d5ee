// SPDX-License-Identifier: MIT
// Roadmap: a map of roads between vertices (docs/design.md, section 1).
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "model/world.h"

namespace grove::detail {

// A point in the plane. Coordinates are in metres.
struct Point {
  double x = 0;
  double y = 0;
  friend bool operator==(const Point&, const Point&) = default;
};

struct Vertex {
  std::string id;
  Point at;
};

// A road from vertex `from` to vertex `to`, which takes `steps` >= 1 steps. Unless `one_way`, it
// leads back as well.
struct Road {
  int from = 0;  // `from` and `to`: positions in Roadmap::vertices()
  int to = 0;
  Time steps = 1;
  bool one_way = false;
};

// The world of vertices and roads. A road of d steps has d - 1 inner places, where agents may wait
// and, on a two-way road, turn back. Immutable: any thread may read it.
class Roadmap : public World {
 public:
  // The location of a place: a vertex, or a number of steps along a road.
  struct Spot {
    int vertex = -1;  // -1: the place is on a road
    int road = -1;
    Time steps = 0;  // from vertex Road::from
  };

  // Throws std::invalid_argument if there are no vertices, a road has fewer than one step, an
  // unknown vertex or equal ends, an id is empty or repeated, or there are more than kMaxPlaces
  // places.
  Roadmap(std::vector<Vertex> vertices, std::vector<Road> roads);

  static constexpr Place kMaxPlaces = 1 << 26;

  const std::vector<Vertex>& vertices() const { return vertices_; }
  const std::vector<Road>& roads() const { return roads_; }

  // The position in vertices() of the vertex with this id. Returns nullopt if there is none.
  std::optional<int> vertex(std::string_view id) const;
  // The place of a vertex; and the place that is `steps` steps from the start of a road, where
  // 0 <= steps <= Road::steps.
  Place place_of_vertex(int vertex) const { return vertex; }
  Place place_on_road(int road, Time steps) const;
  Spot spot(Place place) const;
  // Coordinates in metres. The inner places of a road divide the line between its ends evenly.
  Point at(Place place) const;
  // The roads that join two vertices, in either direction. The span is empty if there are none.
  std::span<const int> roads_between(int a, int b) const;

  // The path entry in plan files, such as ["A"] or ["A", "B", 2], with the index of the road as a
  // fourth element if several roads join the vertices.
  std::string name(State state) const override;

 private:
  std::vector<Vertex> vertices_;
  std::vector<Road> roads_;
  std::vector<Place> first_inner_;  // by road; then the number of places
  std::map<std::pair<int, int>, std::vector<int>> by_ends_;
  std::unordered_map<std::string, int> by_id_;
};

}  // namespace grove::detail
