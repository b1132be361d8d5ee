// SPDX-License-Identifier: MIT
#include "model/roadmap.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "model/assert.h"

namespace grove::detail {
namespace {

void require_roads_between(const std::vector<Road>& roads, std::size_t vertices) {
  const auto is_vertex = [&](int v) { return v >= 0 && static_cast<std::size_t>(v) < vertices; };
  std::int64_t places = static_cast<std::int64_t>(vertices);
  for (const Road& road : roads) {
    if (!is_vertex(road.from) || !is_vertex(road.to) || road.from == road.to || road.steps < 1)
      throw std::invalid_argument(
          "a road must join two different vertices and take at least one step");
    places += road.steps - 1;
    if (places > Roadmap::kMaxPlaces)
      throw std::invalid_argument(
          fmt::format("a roadmap has at most {} places", Roadmap::kMaxPlaces));
  }
}

// The first inner place of each road. The inner places of a road are numbered consecutively.
std::vector<Place> inner_places(const std::vector<Road>& roads, std::size_t vertices) {
  require_roads_between(roads, vertices);
  std::vector<Place> first{static_cast<Place>(vertices)};
  for (const Road& road : roads) first.push_back(first.back() + road.steps - 1);
  return first;
}

Place on_road(const Road& road, Place first_inner, Time steps) {
  if (steps == 0) return road.from;
  return steps == road.steps ? road.to : first_inner + steps - 1;
}

CsrArray moves_on(const std::vector<Road>& roads, std::size_t vertices) {
  const std::vector<Place> first_inner = inner_places(roads, vertices);
  std::vector<std::vector<Place>> moves(static_cast<std::size_t>(first_inner.back()));
  const auto add = [&](Place from, Place to) {
    if (std::ranges::count(moves[from], to) == 0) moves[from].push_back(to);
  };
  for (std::size_t r = 0; r < roads.size(); ++r)
    for (Time step = 0; step < roads[r].steps; ++step) {
      const Place here = on_road(roads[r], first_inner[r], step);
      const Place next = on_road(roads[r], first_inner[r], step + 1);
      add(here, next);
      if (!roads[r].one_way) add(next, here);
    }
  CsrArray rows;
  for (const auto& row : moves) {
    for (const Place to : row) rows.add(to);
    rows.end_row();
  }
  return rows;
}

}  // namespace

Roadmap::Roadmap(std::vector<Vertex> vertices, std::vector<Road> roads)
    : World(moves_on(roads, vertices.size())),
      vertices_(std::move(vertices)),
      roads_(std::move(roads)),
      first_inner_(inner_places(roads_, vertices_.size())) {
  if (vertices_.empty()) throw std::invalid_argument("a roadmap needs at least one vertex");
  for (std::size_t v = 0; v < vertices_.size(); ++v) {
    if (vertices_[v].id.empty()) throw std::invalid_argument("a vertex needs an id");
    if (!by_id_.emplace(vertices_[v].id, static_cast<int>(v)).second)
      throw std::invalid_argument("the ids of vertices must be distinct");
  }
  for (std::size_t r = 0; r < roads_.size(); ++r)
    by_ends_[std::minmax(roads_[r].from, roads_[r].to)].push_back(static_cast<int>(r));
  GROVE_CHECK(place_count() == first_inner_.back(),
              "the places are the vertices and the inner "
              "places of roads");
}

std::span<const int> Roadmap::roads_between(int a, int b) const {
  const auto found = by_ends_.find(std::minmax(a, b));
  return found == by_ends_.end() ? std::span<const int>() : std::span(found->second);
}

std::optional<int> Roadmap::vertex(std::string_view id) const {
  const auto found = by_id_.find(std::string(id));
  return found == by_id_.end() ? std::nullopt : std::optional(found->second);
}

Place Roadmap::place_on_road(int road, Time steps) const {
  return on_road(roads_[road], first_inner_[road], steps);
}

Roadmap::Spot Roadmap::spot(Place place) const {
  if (place < static_cast<Place>(vertices_.size())) return {.vertex = place};
  const auto after = std::ranges::upper_bound(first_inner_, place);
  const auto road = static_cast<int>(after - first_inner_.begin()) - 1;
  const Spot spot{.road = road, .steps = place - first_inner_[road] + 1};
  GROVE_ASSERT(spot.steps < roads_[road].steps && place_on_road(road, spot.steps) == place,
               "an inner place is on one road, between its ends");
  return spot;
}

Point Roadmap::at(Place place) const {
  const Spot spot = this->spot(place);
  if (spot.vertex >= 0) return vertices_[spot.vertex].at;
  const Road& road = roads_[spot.road];
  const Point& from = vertices_[road.from].at;
  const Point& to = vertices_[road.to].at;
  const double part = static_cast<double>(spot.steps) / road.steps;
  return {from.x + part * (to.x - from.x), from.y + part * (to.y - from.y)};
}

std::string Roadmap::name(State state) const {
  const Spot spot = this->spot(place(state));
  if (spot.vertex >= 0) return fmt::format("[\"{}\"]", vertices_[spot.vertex].id);
  const Road& road = roads_[spot.road];
  const bool is_only_one = roads_between(road.from, road.to).size() == 1;
  const std::string twin = is_only_one ? "" : fmt::format(", {}", spot.road);
  return fmt::format("[\"{}\", \"{}\", {}{}]", vertices_[road.from].id, vertices_[road.to].id,
                     spot.steps, twin);
}

}  // namespace grove::detail
