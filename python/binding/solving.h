// SPDX-License-Identifier: MIT
// Long calls of the library from Python: they release the GIL and end on Ctrl-C.
#pragma once

#include <functional>

#include "python/binding/values.h"

namespace grove::python {

// Options of a call. `arguments`: all arguments of grove.solve().
struct Call {
  explicit Call(const Instance& instance, const py::dict& arguments);

  Options options;
  py::object stop;  // a threading.Event, or None
  std::stop_source source;
};

// Runs `solve` on another thread, so that this one can handle signals; returns its result.
Solution run_on_search_thread(Call& call, const std::function<Solution()>& solve);

}  // namespace grove::python
