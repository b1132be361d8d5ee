// SPDX-License-Identifier: MIT
// grove._grove: Python bindings of the public API. grove/__init__.py holds the parts that are
// written in Python.
#include <exception>

#include "python/binding/values.h"

namespace grove::python {
namespace {

// Python exception classes for the exceptions of the library. Never freed.
struct Errors {
  py::object base;
  py::object input;
  py::object argument;
};
Errors* errors = nullptr;

py::object error_class(py::module_& module, const char* name, const py::tuple& bases,
                       const char* text) {
  py::dict body;
  body["__doc__"] = text;
  body["__module__"] = "grove";
  const auto type = py::reinterpret_borrow<py::object>(reinterpret_cast<PyObject*>(&PyType_Type));
  py::object made = type(name, bases, body);
  module.attr(name) = made;
  return made;
}

void raise(const py::object& type, const Error& error, const std::string* field) {
  const py::object made = type(error.what());
  if (field != nullptr) made.attr("field") = *field;
  PyErr_SetObject(type.ptr(), made.ptr());
}

void add_errors(py::module_& module) {
  const auto exception = py::reinterpret_borrow<py::object>(PyExc_Exception);
  const auto value_error = py::reinterpret_borrow<py::object>(PyExc_ValueError);
  errors = new Errors;
  errors->base =
      error_class(module, "Error", py::make_tuple(exception),
                  "Base class of Grove's errors. Raised directly only for an internal error.");
  errors->input = error_class(module, "InputError", py::make_tuple(errors->base, value_error),
                              "An invalid file, text, agent or task; the message states the "
                              "position and what was expected.");
  errors->argument = error_class(
      module, "InvalidArgument", py::make_tuple(errors->base, value_error),
      "An invalid world, plan, option or other argument; field locates it, such as '/omega'.");
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const InvalidArgument& error) {
      raise(errors->argument, error, &error.field());
    } catch (const InputError& error) {
      raise(errors->input, error, nullptr);
    } catch (const Error& error) {
      raise(errors->base, error, nullptr);
    }
  });
}

}  // namespace

PYBIND11_MODULE(_grove, module) {
  // Classes that are added under this name print as members of the package grove.
  module.attr("__name__") = "grove";
  module.attr("__version__") = GROVE_VERSION;
  add_errors(module);
  add_world(module);
  add_instance(module);
  add_plan(module);
  add_solve(module);
  add_session(module);
  add_page(module);
  module.attr("__name__") = "grove._grove";
}

}  // namespace grove::python
