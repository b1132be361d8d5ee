// SPDX-License-Identifier: MIT
#include "io/roadmap_file.h"

#include <fmt/format.h>

#include <cstdint>
#include <unordered_map>
#include <utility>

#include "io/json_text.h"
#include "io/json_value.h"
#include "io/known_keys.h"
#include "io/text_file.h"

namespace grove::detail {
namespace {

using OrderedJson = nlohmann::ordered_json;
using Numbers = std::unordered_map<std::string, int>;

Point read_point(const JsonValue& value) {
  if (value.size() != 2) value.fail_expected("[x, y] in metres");
  return {value.element(0).number(), value.element(1).number()};
}

std::vector<Vertex> read_vertices(const JsonValue& list, Numbers& numbers) {
  std::vector<Vertex> vertices;
  if (list.size() == 0) list.fail("expected at least one vertex");
  for (std::size_t i = 0; i < list.size(); ++i) {
    const JsonValue vertex = list.element(i);
    const JsonValue id = vertex.member("id");
    if (id.text().empty()) id.fail("expected an id that is not empty");
    if (!numbers.emplace(id.text(), static_cast<int>(i)).second)
      id.fail(fmt::format("id '{}' is used twice; expected distinct ids", id.text()));
    vertices.push_back({id.text(), read_point(vertex.member("at"))});
  }
  return vertices;
}

int read_end(const JsonValue& id, const Numbers& numbers) {
  const auto found = numbers.find(id.text());
  if (found == numbers.end())
    id.fail(fmt::format("there is no vertex '{}'; expected the id of one of this file", id.text()));
  return found->second;
}

Time read_steps(const JsonValue& value) {
  if (value.json().is_number_float())
    value.fail_expected(
        "a whole number of steps, at least 1; 'grove convert --metres-per-step' converts lengths "
        "in GraphML or LIF to steps, rounded up");
  return static_cast<Time>(value.integer(1, Roadmap::kMaxPlaces));
}

std::vector<Road> read_roads(const JsonValue& list, const Numbers& numbers, std::int64_t places,
                             const std::string& file, const InputRules& rules) {
  std::vector<Road> roads;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const JsonValue edge = list.element(i);
    Road road{read_end(edge.member("from"), numbers), read_end(edge.member("to"), numbers),
              read_steps(edge.member("steps")), false};
    if (road.from == road.to)
      edge.fail("from and to are the same vertex; expected two different ones");
    if (const auto one_way = edge.find("one_way")) road.one_way = one_way->boolean();
    places += road.steps - 1;
    if (places > Roadmap::kMaxPlaces)
      edge.fail(fmt::format("the roads up to this one have more than {} places; expected fewer",
                            Roadmap::kMaxPlaces));
    require_memory(rules, file, edge.path(), places, "places of the roads up to this one",
                   kBytesPerPlace);
    roads.push_back(road);
  }
  return roads;
}

OrderedJson road_json(const Roadmap& roadmap, const Road& road) {
  OrderedJson json{{"from", roadmap.vertices()[road.from].id},
                   {"to", roadmap.vertices()[road.to].id},
                   {"steps", road.steps}};
  if (road.one_way) json["one_way"] = true;
  return json;
}

}  // namespace

Roadmap read_roadmap(const std::filesystem::path& path, const InputRules& rules) {
  return parse_roadmap(read_text(path), path.string(), rules);
}

Roadmap parse_roadmap(std::string_view text, const std::string& name, const InputRules& rules) {
  const JsonDocument document(text, name);
  const JsonValue root = document.root();
  require_known_keys(root, roadmap_keys());
  Numbers numbers;
  std::vector<Vertex> vertices = read_vertices(root.member("vertices"), numbers);
  std::vector<Road> roads =
      read_roads(root.member("edges"), numbers, std::ssize(vertices), name, rules);
  return Roadmap(std::move(vertices), std::move(roads));
}

void write_roadmap(const std::filesystem::path& path, const Roadmap& roadmap,
                   Durability durability) {
  OrderedJson vertices = OrderedJson::array();
  for (const Vertex& vertex : roadmap.vertices())
    vertices.push_back({{"id", vertex.id}, {"at", {vertex.at.x, vertex.at.y}}});
  OrderedJson edges = OrderedJson::array();
  for (const Road& road : roadmap.roads()) edges.push_back(road_json(roadmap, road));
  write_file_atomically(path, dump_by_lines({{"vertices", vertices}, {"edges", edges}}),
                        durability);
}

}  // namespace grove::detail
