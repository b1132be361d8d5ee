// SPDX-License-Identifier: MIT
// Runs long library calls without the GIL, and stops them on Ctrl-C.
#pragma once

#include <functional>

#include "python/binding/values.h"

namespace grove::python {

// Options of a solve, converted from `arguments`, which must contain an entry for every keyword
// argument of grove.solve().
struct Call {
  explicit Call(const Instance& instance, const py::dict& arguments);

  Options options;
  py::object stop;  // a threading.Event, or None
  std::stop_source source;
};

// Runs `solve` on another thread and returns its result or rethrows its exception. In the meantime
// the calling thread runs Python's signal handlers and polls call.stop. It stops the search if
// call.stop is set or a signal handler raises an exception, which it rethrows.
Solution run_on_search_thread(Call& call, const std::function<Solution()>& solve);

}  // namespace grove::python
