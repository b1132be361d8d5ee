// SPDX-License-Identifier: MIT
// A long call of the library from Python: without the interpreter lock, ended by Ctrl-C.
#pragma once

#include <functional>

#include "python/binding/values.h"

namespace grove::python {

// `arguments`: of grove.solve(), each with a value.
struct Call {
  explicit Call(const Instance& instance, const py::dict& arguments);

  Options options;
  py::object stop;  // an event of Python's, or none
  std::stop_source source;
};

// What `solve` returns. It runs on a thread of its own, so that this one can hear signals.
Solution run_aside(Call& call, const std::function<Solution()>& solve);

}  // namespace grove::python
