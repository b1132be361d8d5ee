// SPDX-License-Identifier: MIT
#include "io/path_entry.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <string_view>

#include "model/assert.h"

namespace grove::detail {
namespace {

constexpr std::string_view kOnARoadmap =
    "a vertex [\"A\"] or a place on a road [\"A\", \"B\", k], k steps from A";

int read_vertex_id(const Roadmap& roadmap, const JsonValue& id) {
  const auto vertex = roadmap.vertex(id.text());
  if (!vertex)
    id.fail(fmt::format("there is no vertex '{}'; expected one of the roadmap", id.text()));
  return *vertex;
}

// The index of the road to which an entry [from, to, steps] or [from, to, steps, road] refers.
int road_meant(const Roadmap& roadmap, const JsonValue& entry, int from, int to) {
  const auto roads = roadmap.roads_between(from, to);
  if (entry.size() == 4) {
    const auto last = static_cast<std::int64_t>(roadmap.roads().size()) - 1;
    const auto road = static_cast<int>(entry.element(3).integer(0, last));
    if (std::ranges::find(roads, road) != roads.end()) return road;
    entry.element(3).fail(
        fmt::format("edge {} does not join these vertices; expected one that does", road));
  }
  if (roads.empty())
    entry.fail("no road joins these vertices; expected two vertices joined by a road");
  if (roads.size() > 1)
    entry.fail(
        fmt::format("{} roads join these vertices; expected a fourth entry, the number of "
                    "the edge in the roadmap (from 0)",
                    roads.size()));
  return roads.front();
}

Place read_road_place(const Roadmap& roadmap, const JsonValue& entry) {
  const int from = read_vertex_id(roadmap, entry.element(0));
  const int to = read_vertex_id(roadmap, entry.element(1));
  const int number = road_meant(roadmap, entry, from, to);
  const Road& road = roadmap.roads()[number];
  if (road.steps == 1) entry.fail("this road has no place between its ends; expected a vertex");
  const auto steps = static_cast<Time>(entry.element(2).integer(1, road.steps - 1));
  const Place place = roadmap.place_on_road(number, road.from == from ? steps : road.steps - steps);
  GROVE_CHECK(roadmap.spot(place).road == number, "a place on a road is one of its inner places");
  return place;
}

Cell cell_on(const Grid& grid, const JsonValue& value, Position p) {
  if (!grid.contains(p))
    value.fail(fmt::format("cell [{}, {}] is outside the map; expected x in 0..{} and y in 0..{}",
                           p.x, p.y, grid.width() - 1, grid.height() - 1));
  return grid.cell(p);
}

Place read_place(const Roadmap& roadmap, const JsonValue& value) {
  if (!value.json().is_array()) value.fail_expected(kOnARoadmap);
  if (value.size() == 1) return roadmap.place_of_vertex(read_vertex_id(roadmap, value.element(0)));
  if (value.size() != 3 && value.size() != 4) value.fail_expected(kOnARoadmap);
  return read_road_place(roadmap, value);
}

nlohmann::ordered_json entry_json(const Roadmap& roadmap, Place place) {
  const Roadmap::Spot spot = roadmap.spot(place);
  if (spot.vertex >= 0) return nlohmann::ordered_json::array({roadmap.vertices()[spot.vertex].id});
  const Road& road = roadmap.roads()[spot.road];
  nlohmann::ordered_json json{roadmap.vertices()[road.from].id, roadmap.vertices()[road.to].id,
                              spot.steps};
  if (roadmap.roads_between(road.from, road.to).size() > 1) json.push_back(spot.road);
  return json;
}

}  // namespace

Heading read_heading(const JsonValue& value) {
  const auto heading = value.json().is_string() ? heading_of(value.text()) : std::nullopt;
  if (!heading) value.fail_expected("\"N\", \"E\", \"S\" or \"W\"");
  return *heading;
}

namespace {

bool is_next_to(Heading heading, Heading other) {
  return other == right_of(heading) || other == left_of(heading);
}

Pose read_turning_pose(const Grid& grid, Motion motion, const JsonValue& value) {
  if (!value.json().is_array() || (value.size() != 3 && value.size() != 5))
    value.fail_expected(
        "[x, y, heading], heading \"N\", \"E\", \"S\" or \"W\", or [x, y, heading, next, k], k "
        "steps made of the turn to the next heading, for an agent that turns");
  const Position p{value.element(0).coordinate(), value.element(1).coordinate()};
  const Heading heading = read_heading(value.element(2));
  Pose pose{cell_on(grid, value, p), heading, heading, 0};
  if (value.size() == 3) return pose;
  pose.to = read_heading(value.element(3));
  if (!is_next_to(heading, pose.to))
    value.element(3).fail_expected("the heading a quarter turn to the right or to the left");
  if (motion.turn_steps == 1)
    value.fail(
        "found a turn, but a quarter turn of this agent takes one step; expected [x, y, heading]");
  pose.steps = static_cast<Time>(value.element(4).integer(1, motion.turn_steps - 1));
  return pose;
}

}  // namespace

Pose read_pose(const Map& map, Motion motion, const JsonValue& value) {
  if (const auto* roadmap = std::get_if<Roadmap>(&map))
    return {.place = read_place(*roadmap, value)};
  const auto& grid = std::get<Grid>(map);
  if (motion.turn_steps == 0) return {.place = cell_on(grid, value, value.position())};
  return read_turning_pose(grid, motion, value);
}

nlohmann::ordered_json pose_json(const Map& map, Motion motion, const Pose& pose) {
  if (const auto* roadmap = std::get_if<Roadmap>(&map)) return entry_json(*roadmap, pose.place);
  const Position p = std::get<Grid>(map).position(pose.place);
  nlohmann::ordered_json json{p.x, p.y};
  if (motion.turn_steps == 0) return json;
  json.push_back(std::string(1, letter(pose.heading)));
  if (pose.steps == 0) return json;
  json.push_back(std::string(1, letter(pose.to)));
  json.push_back(pose.steps);
  return json;
}

Place read_vertex(const Roadmap& roadmap, const JsonValue& value) {
  const bool in_brackets = value.json().is_array() && value.size() == 1;
  const JsonValue id = in_brackets ? value.element(0) : value;
  if (!id.json().is_string()) value.fail_expected("the id of a vertex");
  return roadmap.place_of_vertex(read_vertex_id(roadmap, id));
}

Place read_start(const Roadmap& roadmap, const JsonValue& value) {
  return value.json().is_string() ? read_vertex(roadmap, value) : read_place(roadmap, value);
}

}  // namespace grove::detail
