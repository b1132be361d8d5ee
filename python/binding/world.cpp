// SPDX-License-Identifier: MIT
#include <pybind11/numpy.h>

#include <algorithm>
#include <vector>

#include "python/binding/values.h"

namespace grove::python {
namespace {

using Bools = py::array_t<bool, py::array::c_style>;

// Lines of one text, or a list of them.
World from_rows(const py::object& rows) {
  if (!py::isinstance<py::str>(rows))
    return World::from_rows(rows.cast<std::vector<std::string>>());
  const py::object lines = rows.attr("strip")("\n").attr("splitlines")();
  std::vector<std::string> stripped;
  for (const py::handle& line : lines)
    stripped.push_back(line.attr("strip")().cast<std::string>());
  return World::from_rows(stripped);
}

World grid(const Bools& passable) {
  if (passable.ndim() != 2)
    throw InvalidArgument("/passable", "expected an array of two dimensions, rows and columns");
  const bool* cells = passable.data();
  return World::grid(static_cast<int>(passable.shape(1)), static_cast<int>(passable.shape(0)),
                     std::vector<bool>(cells, cells + passable.size()));
}

World roadmap(const py::dict& vertices, const py::iterable& roads) {
  std::vector<RoadmapVertex> points;
  for (const auto& [id, at] : vertices) {
    const auto place = at.cast<std::pair<double, double>>();
    points.push_back({id.cast<std::string>(), place.first, place.second});
  }
  std::vector<RoadmapEdge> edges;
  for (const py::handle& road : roads) {
    const auto parts = py::cast<py::sequence>(road);
    if (parts.size() < 3 || parts.size() > 4)
      throw InvalidArgument("/roads", "expected (from, to, steps) or (from, to, steps, one_way)");
    edges.push_back({parts[0].cast<std::string>(), parts[1].cast<std::string>(),
                     parts[2].cast<int>(), parts.size() == 4 && parts[3].cast<bool>()});
  }
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

std::string text_of(const World& world) {
  const auto count = [](std::size_t n) { return std::to_string(n); };
  if (!world.is_grid())
    return "<grove.World: " + count(world.vertices().size()) + " vertices, " +
           count(world.edges().size()) + " roads>";
  std::size_t passable = 0;
  for (int y = 0; y < world.height(); ++y)
    for (int x = 0; x < world.width(); ++x) passable += world.passable({x, y});
  return "<grove.World: " + std::to_string(world.width()) + " x " +
         std::to_string(world.height()) + " cells, " + count(passable) + " passable>";
}

}  // namespace

void add_world(py::module_& module) {
  py::class_<World>(module, "World",
                    "What robots move on: cells of a grid, or vertices and roads. Never changes.\n\n"
                    "World(rows): of '.' (passable) and '@' or '#' (blocked), one text or a list.")
      .def(py::init(&from_rows), py::arg("rows"))
      .def_static("grid", &grid, py::arg("passable"),
                  "From an array of two dimensions, rows and columns: true where one can go.")
      .def_static("roadmap", &roadmap, py::arg("vertices"), py::arg("roads"),
                  "{'A': (x, y), ...} in metres and [('A', 'B', steps), ('B', 'C', steps, True), "
                  "...]; True: one way.")
      .def_static("read", &World::read, py::arg("path"),
                  "A Moving AI map (*.map), or a roadmap (*.roadmap.json).")
      .def_property_readonly("is_grid", &World::is_grid, "Else it is a roadmap.")
      .def_property_readonly("width", &World::width, "In cells; 0 of a roadmap.")
      .def_property_readonly("height", &World::height, "In cells; 0 of a roadmap.")
      .def_property_readonly("passable", &passable, "An array of rows and columns, true where one can go.")
      .def_property_readonly("vertices", &vertices, "{'A': (x, y), ...}, in metres.")
      .def_property_readonly("roads", &roads, "[(from, to, steps, one_way), ...].")
      .def("__repr__", &text_of);
}

}  // namespace grove::python
