// SPDX-License-Identifier: MIT
// Roads between named points, as fleets drive on (docs/design.md, section 1).
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

// Metres.
struct Point {
  double x = 0;
  double y = 0;
  friend bool operator==(const Point&, const Point&) = default;
};

struct Vertex {
  std::string id;
  Point at;
};

// From one vertex to another in so many steps; back as well, unless it is one way.
struct Road {
  int from = 0;  // positions in Roadmap::vertices()
  int to = 0;
  Time steps = 1;
  bool one_way = false;
};

// A world of vertices and roads. A road of d steps has d - 1 places between its ends, where agents
// may wait and, on a two-way road, turn back. Immutable after construction, so any number of
// threads may read one.
class Roadmap : public World {
 public:
  // Where a place is: at a vertex, or on a road.
  struct Spot {
    int vertex = -1;  // -1: on a road
    int road = -1;
    Time steps = 0;  // from where the road begins
  };

  // Throws std::invalid_argument for no vertex at all, roads of no steps or between vertices that
  // are not there, ids that are empty or repeated, and more than kMostPlaces places.
  Roadmap(std::vector<Vertex> vertices, std::vector<Road> roads);

  static constexpr Place kMostPlaces = 1 << 26;

  const std::vector<Vertex>& vertices() const { return vertices_; }
  const std::vector<Road>& roads() const { return roads_; }

  // The vertex with this id, by position; none.
  std::optional<int> vertex(std::string_view id) const;
  // The place of a vertex, and the one `steps` from the beginning of a road: 0 .. its length.
  Place place_of_vertex(int vertex) const { return vertex; }
  Place place_on_road(int road, Time steps) const;
  Spot spot(Place place) const;
  // In metres; places on a road are spread evenly over it.
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
