// SPDX-License-Identifier: MIT
// Conversions between values of the public API and Python values. A place is a tuple or a str.
// Plans and solutions also hold their instance.
#pragma once

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "grove/grove.hpp"

namespace grove::python {

namespace py = pybind11;

// A plan and its instance. The plan is shared, because plans are large.
struct PlanOfInstance {
  Instance instance;
  std::shared_ptr<const Plan> plan;
};

struct SolutionOfInstance {
  Instance instance;
  Solution facts;  // without the plan
  std::optional<PlanOfInstance> plan;

  static SolutionOfInstance of(const Instance& instance, Solution solution) {
    SolutionOfInstance own{instance, {}, {}};
    if (solution.plan)
      own.plan = PlanOfInstance{instance, std::make_shared<const Plan>(*std::move(solution.plan))};
    solution.plan.reset();
    own.facts = std::move(solution);
    return own;
  }
  Solution whole() const {
    Solution solution = facts;
    if (plan) solution.plan = *plan->plan;
    return solution;
  }
};

// Returns "north", "east", "south" or "west".
inline const char* name_of(Heading heading) {
  constexpr const char* kNames[] = {"north", "east", "south", "west"};
  return kNames[static_cast<int>(heading)];
}

// Describes a value for error messages: an array by element type and shape, another value by its
// repr() or, if that is long, by its type.
inline std::string text_of_found(const py::handle& value) {
  constexpr std::size_t kMaxTextLength = 60;
  if (py::hasattr(value, "dtype") && py::hasattr(value, "shape"))
    return "an array of " + std::string(py::str(value.attr("dtype"))) + " of shape " +
           std::string(py::str(value.attr("shape")));
  const std::string text = py::repr(value);
  if (text.size() <= kMaxTextLength) return text;
  return "a " + std::string(py::str(py::type::of(value).attr("__name__")));
}

// Converts a Python value to T. Throws InvalidArgument, with `field` and `expected`, instead of
// pybind11's exception.
template <class T>
T value_of(const py::handle& value, const std::string& field, const std::string& expected) {
  try {
    return value.cast<T>();
  } catch (const py::cast_error&) {
  } catch (const py::error_already_set& error) {  // from NumPy, which converts arrays
    if (!error.matches(PyExc_TypeError) && !error.matches(PyExc_ValueError)) throw;
  }
  throw InvalidArgument(field, "found " + text_of_found(value) + "; expected " + expected);
}

// Returns the elements of a list, an array or another iterable. Throws InvalidArgument if `value`
// is a str or not iterable.
inline std::vector<py::object> elements_of(const py::handle& value, const std::string& field,
                                           const std::string& expected) {
  if (!py::isinstance<py::iterable>(value) || py::isinstance<py::str>(value))
    throw InvalidArgument(field, "found " + text_of_found(value) + "; expected " + expected);
  std::vector<py::object> all;
  for (const py::handle& element : value)
    all.push_back(py::reinterpret_borrow<py::object>(element));
  return all;
}

inline constexpr const char* kPlaceExpected =
    "a cell (x, y), a vertex 'A', or a place on a road ('A', 'B', steps)";

void add_world(py::module_& module);
void add_instance(py::module_& module);
void add_plan(py::module_& module);
void add_solve(py::module_& module);
void add_session(py::module_& module);
void add_page(py::module_& module);

}  // namespace grove::python

namespace pybind11::detail {

// Converts a Place from and to a cell (x, y), a vertex "A" or a place on a road
// ("A", "B", steps[, edge]).
template <>
struct type_caster<grove::Place> {
  PYBIND11_TYPE_CASTER(grove::Place, const_name("Place"));

  bool load(handle source, bool convert) {
    if (isinstance<str>(source)) {
      value = grove::Vertex{source.cast<std::string>()};
      return true;
    }
    if (!isinstance<sequence>(source)) return false;
    const auto parts = reinterpret_borrow<sequence>(source);
    if (parts.size() == 2) return load_cell(parts, convert);
    return (parts.size() == 3 || parts.size() == 4) && load_road(parts);
  }

  static handle cast(const grove::Place& place, return_value_policy, handle) {
    if (const auto* cell = std::get_if<grove::Cell>(&place))
      return pybind11::make_tuple(cell->x, cell->y).release();
    if (const auto* vertex = std::get_if<grove::Vertex>(&place)) return str(vertex->id).release();
    const auto& road = std::get<grove::OnRoad>(place);
    if (road.edge)
      return pybind11::make_tuple(road.from, road.to, road.steps, *road.edge).release();
    return pybind11::make_tuple(road.from, road.to, road.steps).release();
  }

 private:
  bool load_cell(const sequence& parts, bool convert) {
    make_caster<int> x, y;
    if (!x.load(object(parts[0]), convert) || !y.load(object(parts[1]), convert)) return false;
    value = grove::Cell{cast_op<int>(x), cast_op<int>(y)};
    return true;
  }
  bool load_road(const sequence& parts) {
    if (!isinstance<str>(object(parts[0])) || !isinstance<str>(object(parts[1]))) return false;
    grove::OnRoad road{parts[0].cast<std::string>(), parts[1].cast<std::string>(),
                       parts[2].cast<int>(), std::nullopt};
    if (parts.size() == 4) road.edge = parts[3].cast<int>();
    value = std::move(road);
    return true;
  }
};

}  // namespace pybind11::detail
