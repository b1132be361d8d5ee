// SPDX-License-Identifier: MIT
#include "grove/world.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "api/access.h"
#include "io/map_file.h"
#include "io/roadmap_file.h"

namespace grove {
namespace {

constexpr std::string_view kPassable = ". ";
constexpr std::string_view kBlocked = "@#TOW";

template <class Make>
World made(Make&& make) {
  try {
    return Access::world(std::make_shared<const detail::Map>(make()));
  } catch (const std::invalid_argument& error) {
    throw InvalidArgument("", error.what());
  }
}

const detail::Grid* grid_of(const World& world) {
  return std::get_if<detail::Grid>(Access::map(world).get());
}
const detail::Roadmap* roadmap_of(const World& world) {
  return std::get_if<detail::Roadmap>(Access::map(world).get());
}

int vertex_of(const detail::Roadmap& roadmap, const std::string& id, const std::string& field) {
  const std::optional<int> vertex = roadmap.vertex(id);
  if (!vertex) throw InvalidArgument(field, fmt::format("there is no vertex '{}'", id));
  return *vertex;
}

// Returns the index of the road that the place is on.
int road_of(const detail::Roadmap& roadmap, const OnRoad& place, const std::string& field) {
  const auto roads = roadmap.roads_between(vertex_of(roadmap, place.from, field),
                                           vertex_of(roadmap, place.to, field));
  if (place.edge && std::ranges::find(roads, *place.edge) != roads.end()) return *place.edge;
  if (place.edge || roads.size() != 1)
    throw InvalidArgument(
        field, fmt::format("{} roads join {} and {}; expected an edge number that selects one",
                           roads.size(), place.from, place.to));
  return roads.front();
}

detail::Place on_road(const detail::Roadmap& roadmap, const OnRoad& place,
                      const std::string& field) {
  const int number = road_of(roadmap, place, field);
  const detail::Road& road = roadmap.roads()[number];
  if (place.steps < 1 || place.steps >= road.steps)
    throw InvalidArgument(field, fmt::format("{} steps from {}; expected from 1 to {}", place.steps,
                                             place.from, road.steps - 1));
  const bool is_forward = roadmap.vertices()[road.from].id == place.from;
  return roadmap.place_on_road(number, is_forward ? place.steps : road.steps - place.steps);
}

}  // namespace

std::string to_string(const Place& place) {
  if (const auto* cell = std::get_if<Cell>(&place))
    return fmt::format("[{}, {}]", cell->x, cell->y);
  if (const auto* vertex = std::get_if<Vertex>(&place)) return fmt::format("[\"{}\"]", vertex->id);
  const auto& road = std::get<OnRoad>(place);
  return fmt::format("[\"{}\", \"{}\", {}]", road.from, road.to, road.steps);
}

World World::grid(int width, int height, const std::vector<bool>& passable) {
  return made([&] { return detail::Grid(width, height, passable); });
}

World World::from_rows(const std::vector<std::string>& rows) {
  const std::size_t width = rows.empty() ? 0 : rows.front().size();
  std::vector<bool> passable;
  for (std::size_t y = 0; y < rows.size(); ++y) {
    if (rows[y].size() != width)
      throw InvalidArgument(fmt::format("/{}", y),
                            fmt::format("found {} characters; expected {}, as in the first row",
                                        rows[y].size(), width));
    for (const char c : rows[y]) {
      passable.push_back(kPassable.find(c) != std::string_view::npos);
      if (!passable.back() && kBlocked.find(c) == std::string_view::npos)
        throw InvalidArgument(
            fmt::format("/{}", y),
            fmt::format("found '{}'; expected '.' or ' ', or one of {}", c, kBlocked));
    }
  }
  return grid(static_cast<int>(width), static_cast<int>(rows.size()), passable);
}

World World::roadmap(std::vector<RoadmapVertex> vertices, std::vector<RoadmapEdge> edges) {
  std::vector<detail::Vertex> all;
  std::unordered_map<std::string, int> by_id;
  for (const RoadmapVertex& v : vertices) {
    by_id.emplace(v.id, static_cast<int>(all.size()));
    all.push_back({v.id, {v.x, v.y}});
  }
  std::vector<detail::Road> roads;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const auto end = [&](const std::string& id, const char* name) {
      const auto found = by_id.find(id);
      if (found == by_id.end())
        throw InvalidArgument(fmt::format("/edges/{}/{}", i, name),
                              fmt::format("there is no vertex '{}'", id));
      return found->second;
    };
    roads.push_back(
        {end(edges[i].from, "from"), end(edges[i].to, "to"), edges[i].steps, edges[i].one_way});
    if (roads.back().from == roads.back().to)
      throw InvalidArgument(fmt::format("/edges/{}", i),
                            "from and to are the same vertex; expected two different ones");
  }
  return made([&] { return detail::Roadmap(std::move(all), std::move(roads)); });
}

World World::read(const std::filesystem::path& path) {
  return with_public_exceptions([&] {
    if (path.extension() == ".json")
      return Access::world(std::make_shared<const detail::Map>(detail::read_roadmap(path)));
    return Access::world(std::make_shared<const detail::Map>(detail::read_map(path)));
  });
}

bool World::is_grid() const {
  return grid_of(*this) != nullptr;
}
int World::width() const {
  return is_grid() ? grid_of(*this)->width() : 0;
}
int World::height() const {
  return is_grid() ? grid_of(*this)->height() : 0;
}
bool World::passable(Cell cell) const {
  const detail::Grid* grid = grid_of(*this);
  return grid != nullptr && grid->contains({cell.x, cell.y}) &&
         grid->passable(grid->cell({cell.x, cell.y}));
}

std::vector<RoadmapVertex> World::vertices() const {
  std::vector<RoadmapVertex> to_public;
  if (const detail::Roadmap* roadmap = roadmap_of(*this))
    for (const detail::Vertex& v : roadmap->vertices()) to_public.push_back({v.id, v.at.x, v.at.y});
  return to_public;
}

std::vector<RoadmapEdge> World::edges() const {
  std::vector<RoadmapEdge> to_public;
  if (const detail::Roadmap* roadmap = roadmap_of(*this))
    for (const detail::Road& road : roadmap->roads())
      to_public.push_back({roadmap->vertices()[road.from].id, roadmap->vertices()[road.to].id,
                           road.steps, road.one_way});
  return to_public;
}

detail::Place place_of(const detail::Map& map, const Place& place, const std::string& field) {
  const auto* roadmap = std::get_if<detail::Roadmap>(&map);
  if (const auto* cell = std::get_if<Cell>(&place)) {
    if (roadmap != nullptr)
      throw InvalidArgument(field, "found a cell; expected a vertex of the roadmap");
    const auto& grid = std::get<detail::Grid>(map);
    if (!grid.contains({cell->x, cell->y}))
      throw InvalidArgument(field, fmt::format("cell {} is outside the map of {} x {}",
                                               to_string(place), grid.width(), grid.height()));
    return grid.cell({cell->x, cell->y});
  }
  if (roadmap == nullptr)
    throw InvalidArgument(field, "found a place on a roadmap; expected a cell of the grid");
  if (const auto* vertex = std::get_if<Vertex>(&place))
    return roadmap->place_of_vertex(vertex_of(*roadmap, vertex->id, field));
  return on_road(*roadmap, std::get<OnRoad>(place), field);
}

Place public_place(const detail::Map& map, detail::Place place) {
  if (const auto* grid = std::get_if<detail::Grid>(&map)) {
    const detail::Position p = grid->position(place);
    return Cell{p.x, p.y};
  }
  const auto& roadmap = std::get<detail::Roadmap>(map);
  const detail::Roadmap::Spot spot = roadmap.spot(place);
  if (spot.vertex >= 0) return Vertex{roadmap.vertices()[spot.vertex].id};
  const detail::Road& road = roadmap.roads()[spot.road];
  const bool is_one_of_many = roadmap.roads_between(road.from, road.to).size() > 1;
  return OnRoad{roadmap.vertices()[road.from].id, roadmap.vertices()[road.to].id, spot.steps,
                is_one_of_many ? std::optional<int>(spot.road) : std::nullopt};
}

}  // namespace grove
