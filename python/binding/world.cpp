// SPDX-License-Identifier: MIT
#include <pybind11/numpy.h>

#include <algorithm>
#include <vector>

#include "python/binding/values.h"

namespace grove::python {
namespace {

using Bools = py::array_t<bool, py::array::c_style>;

// Makes a grid from the lines of a str, or from a list of str, one per row.
World from_rows(const py::object& rows) {
  if (!py::isinstance<py::str>(rows))
    return World::from_rows(value_of<std::vector<std::string>>(
        rows, "/rows", "a text, or a list of texts, one for each row; World.grid() takes arrays"));
  const py::object lines = rows.attr("strip")("\n").attr("splitlines")();
  std::vector<std::string> stripped;
  for (const py::handle& line : lines) stripped.push_back(line.attr("strip")().cast<std::string>());
  return World::from_rows(stripped);
}

World grid(const py::object& given) {
  constexpr const char* kExpected = "an array of bool of two dimensions, rows and columns";
  const auto passable = value_of<Bools>(given, "/passable", kExpected);
  if (passable.ndim() != 2)
    throw InvalidArgument("/passable",
                          "found " + text_of_found(passable) + "; expected " + kExpected);
  const bool* cells = passable.data();
  return World::grid(static_cast<int>(passable.shape(1)), static_cast<int>(passable.shape(0)),
                     std::vector<bool>(cells, cells + passable.size()));
}

RoadmapEdge edge_of(const py::object& road, const std::string& field) {
  constexpr const char* kExpected = "(from, to, steps) or (from, to, steps, one_way)";
  const std::vector<py::object> parts = elements_of(road, field, kExpected);
  if (parts.size() < 3 || parts.size() > 4)
    throw InvalidArgument(field, "found " + text_of_found(road) + "; expected " + kExpected);
  const auto part = [&](std::size_t k) { return field + "/" + std::to_string(k); };
  return {value_of<std::string>(parts[0], part(0), "the id of a vertex"),
          value_of<std::string>(parts[1], part(1), "the id of a vertex"),
          value_of<int>(parts[2], part(2), "a whole number of steps"),
          parts.size() == 4 && value_of<bool>(parts[3], part(3), "True or False")};
}

World roadmap(const py::object& vertices, const py::object& roads) {
  std::vector<RoadmapVertex> points;
  if (!py::isinstance<py::dict>(vertices))
    throw InvalidArgument(
        "/vertices", "found " + text_of_found(vertices) + "; expected a dict {'A': (x, y), ...}");
  for (const auto& [id, at] : py::reinterpret_borrow<py::dict>(vertices)) {
    const auto name = value_of<std::string>(id, "/vertices", "texts as ids");
    const auto place =
        value_of<std::pair<double, double>>(at, "/vertices/" + name, "(x, y) in metres");
    points.push_back({name, place.first, place.second});
  }
  std::vector<RoadmapEdge> edges;
  for (const py::object& road : elements_of(roads, "/roads", "a list of roads"))
    edges.push_back(edge_of(road, "/roads/" + std::to_string(edges.size())));
  return World::roadmap(std::move(points), std::move(edges));
}

Bools passable(const World& world) {
  Bools cells({world.height(), world.width()});
  for (int y = 0; y < world.height(); ++y)
    for (int x = 0; x < world.width(); ++x) cells.mutable_at(y, x) = world.passable({x, y});
  return cells;
}

py::dict vertices(const World& world) {
  py::dict all;
  for (const RoadmapVertex& vertex : world.vertices())
    all[py::str(vertex.id)] = py::make_tuple(vertex.x, vertex.y);
  return all;
}

py::list roads(const World& world) {
  py::list all;
  for (const RoadmapEdge& edge : world.edges())
    all.append(py::make_tuple(edge.from, edge.to, edge.steps, edge.one_way));
  return all;
}

std::string world_summary(const World& world) {
  const auto count = [](std::size_t n) { return std::to_string(n); };
  if (!world.is_grid())
    return "<grove.World: " + count(world.vertices().size()) + " vertices, " +
           count(world.edges().size()) + " roads>";
  std::size_t passable = 0;
  for (int y = 0; y < world.height(); ++y)
    for (int x = 0; x < world.width(); ++x) passable += world.passable({x, y});
  return "<grove.World: " + std::to_string(world.width()) + " x " + std::to_string(world.height()) +
         " cells, " + count(passable) + " passable>";
}

}  // namespace

void add_world(py::module_& module) {
  py::class_<World>(
      module, "World",
      "The map: cells of a grid, or vertices and roads. Immutable.\n\n"
      "World(rows): rows of '.' (passable) and '@' or '#' (blocked), as one text or a list.")
      .def(py::init(&from_rows), py::arg("rows"))
      .def_static("grid", &grid, py::arg("passable"),
                  "Makes a grid from an array of rows x columns; true: passable.")
      .def_static("roadmap", &roadmap, py::arg("vertices"), py::arg("roads"),
                  "Makes a roadmap from {'A': (x, y), ...} in metres and [('A', 'B', steps), "
                  "('B', 'C', steps, True), ...]; True: one way.")
      .def_static("read", &World::read, py::arg("path"),
                  "Reads a Moving AI map (*.map), or a roadmap (*.roadmap.json).")
      .def_property_readonly("is_grid", &World::is_grid, "True for a grid, False for a roadmap.")
      .def_property_readonly("width", &World::width, "Number of columns; 0 for a roadmap.")
      .def_property_readonly("height", &World::height, "Number of rows; 0 for a roadmap.")
      .def_property_readonly("passable", &passable, "Array of rows x columns; true: passable.")
      .def_property_readonly("vertices", &vertices, "Vertices, as {'A': (x, y), ...}, in metres.")
      .def_property_readonly("roads", &roads, "Roads, as [(from, to, steps, one_way), ...].")
      .def("__repr__", &world_summary);
}

}  // namespace grove::python
