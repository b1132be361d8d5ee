// SPDX-License-Identifier: MIT
// Roadmap: roads between named vertices (docs/design.md, section 1).
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

// In metres.
struct Point {
  double x = 0;
  double y = 0;
  friend bool operator==(const Point&, const Point&) = default;
};

struct Vertex {
  std::string id;
  Point at;
};

// A road that takes `steps` steps, from vertex `from` to `to` and, unless `one_way`, back.
struct Road {
  int from = 0;  // positions in Roadmap::vertices()
  int to = 0;
  Time steps = 1;
  bool one_way = false;
};

// The world of vertices and roads. A road of d steps has d - 1 inner places, where agents may wait
// and, on a two-way road, turn back. Immutable: any thread may read it.
class Roadmap : public World {
 public:
  // Position of a place: at a vertex, or on a road.
  struct Spot {
    int vertex = -1;  // -1: on a road
    int road = -1;
    Time steps = 0;  // from the beginning of the road
  };

  // Throws std::invalid_argument if there is no vertex, a road has less than one step or an unknown
  // vertex, an id is empty or repeated, or there are more than kMaxPlaces places.
  Roadmap(std::vector<Vertex> vertices, std::vector<Road> roads);

  static constexpr Place kMaxPlaces = 1 << 26;

  const std::vector<Vertex>& vertices() const { return vertices_; }
  const std::vector<Road>& roads() const { return roads_; }

  // The position of the vertex with this id. Returns nullopt if there is none.
  std::optional<int> vertex(std::string_view id) const;
  // The place of a vertex, and the place `steps` steps from the beginning of a road, 0 <= steps <=
  // length of the road.
  Place place_of_vertex(int vertex) const { return vertex; }
  Place place_on_road(int road, Time steps) const;
  Spot spot(Place place) const;
  // Coordinates in metres. The places on a road are spread evenly.
  Point at(Place place) const;
  // The roads that join two vertices, in either direction; often none.
  std::span<const int> roads_between(int a, int b) const;

  // ["A"] or ["A", "B", 2], as in plan files.
  std::string name(State state) const override;

 private:
  std::vector<Vertex> vertices_;
  std::vector<Road> roads_;
  std::vector<Place> first_inner_;  // by road; one more at the end
  std::map<std::pair<int, int>, std::vector<int>> by_ends_;
  std::unordered_map<std::string, int> by_id_;
};

}  // namespace grove::detail
