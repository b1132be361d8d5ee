// SPDX-License-Identifier: MIT
#include <vector>

#include "python/binding/values.h"

namespace grove::python {
namespace {

// Returns the instance that `read` returns, and issues its warnings as Python UserWarnings.
template <class Read>
Instance with_python_warnings(Read&& read) {
  std::vector<std::string> warnings;
  Instance instance = read(&warnings);
  for (const std::string& warning : warnings)
    if (PyErr_WarnEx(PyExc_UserWarning, warning.c_str(), 1) != 0) throw py::error_already_set();
  return instance;
}

// Makes an instance from a dict in the format of *.cts.json files. The values may be NumPy arrays
// and scalars.
Instance of_dict(const World& world, const py::dict& all, bool following) {
  const py::object plain = py::module_::import("grove").attr("_plain");  // converts NumPy values
  const auto text = py::module_::import("json")
                        .attr("dumps")(all, py::arg("default") = plain)
                        .cast<std::string>();
  return parse_instance(text, world, {.following = following});
}

Instance made(const World& world, const py::object& agents, const py::object& tasks,
              bool following) {
  py::dict all;
  all["agents"] = agents;
  all["tasks"] = tasks;
  return of_dict(world, all, following);
}

py::object json_value(const Instance& instance, const char* key) {
  return py::module_::import("json").attr("loads")(instance_text(instance))[key];
}

std::string instance_summary(const Instance& instance) {
  return "<grove.Instance: " + std::to_string(instance.agents().size()) + " agents, " +
         std::to_string(instance.tasks().size()) + " tasks>";
}

}  // namespace

void add_instance(py::module_& module) {
  py::class_<Instance>(
      module, "Instance",
      "Robots with starts and goals, and the tasks that they visit in any order. Immutable.\n\n"
      "Instance(world, agents, tasks): agents and tasks are dicts as in *.cts.json files: "
      "{'id': 'red', 'start': (0, 0), 'goal': (3, 2)}, "
      "{'id': 'press', 'cell': (1, 2), 'agents': ['red'], 'duration': 3}. A robot may have a "
      "choice "
      "of 'goals', and a task a 'need' of fewer than all its agents.")
      .def(py::init(&made), py::arg("world"), py::arg("agents"), py::arg("tasks") = py::list(),
           py::kw_only(), py::arg("following") = true)
      .def_property_readonly("world", &Instance::world, "The world that the robots move on.")
      .def_property_readonly(
          "agents", [](const Instance& i) { return json_value(i, "agents"); },
          "Agents, as dicts in the format of *.cts.json files.")
      .def_property_readonly(
          "tasks", [](const Instance& i) { return json_value(i, "tasks"); },
          "Tasks, as dicts in the format of *.cts.json files.")
      .def_property_readonly(
          "following", [](const Instance& i) { return i.rules().following; },
          "Whether a robot may enter a place in the step in which another leaves it.")
      .def_property_readonly(
          "has_choices", &Instance::has_choices,
          "Whether a robot may choose its destination, or whether to visit a task.")
      .def(
          "write",
          [](const Instance& i, const std::filesystem::path& path) { write_instance(path, i); },
          py::arg("path"),
          "Writes a *.cts.json file, and the map or roadmap to the same directory.")
      .def("__repr__", &instance_summary);
  module.def("_instance_of_dict", &of_dict);
  module.def(
      "read_instance",
      [](const std::filesystem::path& path, bool confine, std::optional<std::size_t> memory_limit) {
        return with_python_warnings([&](auto* warnings) {
          return read_instance(path, Trust{confine, memory_limit}, warnings);
        });
      },
      py::arg("path"), py::kw_only(), py::arg("confine") = false,
      py::arg("memory_limit") = py::none(),
      "Reads a *.cts.json file and the map or roadmap that it names.\n\n"
      "For untrusted files: with `confine` it refuses a map outside the file's directory; with "
      "`memory_limit` it refuses an instance whose map and robot states would need more bytes.");
  module.def("read_scenario", &read_scenario, py::arg("scenario"), py::arg("map"),
             py::arg("agents"),
             "Reads a classical MAPF instance: the first `agents` rows of a Moving AI scenario.");
}

}  // namespace grove::python
