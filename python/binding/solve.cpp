// SPDX-License-Identifier: MIT
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

#include "python/binding/solving.h"

namespace grove::python {
namespace {

constexpr std::chrono::milliseconds kBetweenSignals{20};

// Returns a shared pointer to a Python function. Its deleter takes the GIL, because a search thread
// without the GIL may drop the last reference.
std::shared_ptr<py::object> shared(const py::object& function) {
  return {new py::object(function), [](py::object* held) {
            const py::gil_scoped_acquire lock;
            delete held;
          }};
}

template <class T>
T argument(const py::dict& arguments, const char* name, const char* expected) {
  try {
    return arguments[name].cast<T>();
  } catch (const py::cast_error&) {
    throw py::type_error(std::string(name) + ": found " + text_of_found(arguments[name]) +
                         "; expected " + expected);
  }
}

void set_callbacks(Options& options, const Instance& instance, const py::dict& arguments) {
  if (const py::object callback = arguments["progress"]; !callback.is_none())
    options.on_progress = [callback = shared(callback)](const Progress& progress) {
      const py::gil_scoped_acquire lock;
      (*callback)(progress);
    };
  if (const py::object callback = arguments["incumbent"]; !callback.is_none())
    options.on_incumbent = [callback = shared(callback), instance](const Plan& plan,
                                                                   const Progress& progress) {
      const py::gil_scoped_acquire lock;
      (*callback)(PlanOfInstance{instance, std::make_shared<const Plan>(plan)}, progress);
    };
}

// A search on a thread of its own. `solve` must outlive it.
class SearchThread {
 public:
  explicit SearchThread(const std::function<Solution()>& solve)
      : thread_([this, &solve] {
          try {
            solution_ = solve();
          } catch (...) {
            failure_ = std::current_exception();
          }
          const std::lock_guard lock(mutex_);
          done_ = true;
          ended_.notify_one();
        }) {}

  // Waits until the search ends, but at most for kBetweenSignals. Returns whether it has ended.
  bool wait() {
    std::unique_lock lock(mutex_);
    return ended_.wait_for(lock, kBetweenSignals, [this] { return done_; });
  }
  void join() { thread_.join(); }
  std::exception_ptr failure() const { return failure_; }
  Solution take() { return std::move(solution_); }

 private:
  std::mutex mutex_;
  std::condition_variable ended_;
  bool done_ = false;
  Solution solution_;
  std::exception_ptr failure_;
  std::thread thread_;
};

}  // namespace

Call::Call(const Instance& instance, const py::dict& arguments) : stop(arguments["stop"]) {
  const auto is_set = [&](const char* name) {
    return !py::isinstance<py::str>(arguments[name]) ||
           arguments[name].cast<std::string>() != "auto";
  };
  options.omega = argument<double>(arguments, "omega", "a number");
  options.time_limit = argument<std::optional<double>>(arguments, "time_limit", "seconds, or None");
  if (is_set("memory_limit"))
    options.memory_limit =
        argument<std::optional<std::size_t>>(arguments, "memory_limit", "bytes, \"auto\" or None");
  options.stop = source.get_token();
  if (is_set("threads"))
    options.threads = argument<int>(arguments, "threads", "a whole number, or \"auto\"");
  options.deterministic = argument<bool>(arguments, "deterministic", "True or False");
  options.seed = argument<std::uint64_t>(arguments, "seed", "a whole number from 0");
  options.method = argument<std::string>(arguments, "method", "the name of a method");
  if (const auto start =
          argument<std::optional<PlanOfInstance>>(arguments, "start", "a Plan, or None"))
    options.start = *start->plan;
  options.progress_interval = argument<double>(arguments, "progress_interval", "seconds");
  options.visit_weight = argument<int>(arguments, "visit_weight", "a whole number from 0 to 100");
  set_callbacks(options, instance, arguments);
}

Solution run_on_search_thread(Call& call, const std::function<Solution()>& solve) {
  std::exception_ptr interrupt;
  std::unique_ptr<SearchThread> search;
  const auto ended = [&] {
    const py::gil_scoped_release release;
    if (!search) search = std::make_unique<SearchThread>(solve);
    return search->wait();
  };
  while (!ended()) {
    if (interrupt) continue;  // a stop is requested already
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      if (!call.stop.is_none() && call.stop.attr("is_set")().cast<bool>())
        call.source.request_stop();
    } catch (...) {
      interrupt = std::current_exception();
      call.source.request_stop();
    }
  }
  search->join();
  if (interrupt) std::rethrow_exception(interrupt);
  if (search->failure()) std::rethrow_exception(search->failure());
  return search->take();
}

void add_solve(py::module_& module) {
  py::class_<Progress>(module, "Progress", "State of a search at one moment.")
      .def_readonly("seconds", &Progress::seconds, "Seconds since the start.")
      .def_readonly("nodes_expanded", &Progress::nodes_expanded, "Constraint-tree nodes expanded.")
      .def_readonly("nodes_open", &Progress::nodes_open, "Constraint-tree nodes still open.")
      .def_readonly("lower_bound", &Progress::lower_bound, "Lower bound proven so far.")
      .def_readonly("cost", &Progress::cost, "Cost of the best plan so far, or None.")
      .def("__repr__", [](const Progress& p) {
        return "<grove.Progress: cost " + (p.cost ? std::to_string(*p.cost) : "-") +
               ", lower bound " + std::to_string(p.lower_bound) + ">";
      });
  // Defaults of the library, which grove/__init__.py uses as default arguments.
  const Options defaults;
  module.attr("_omega") = defaults.omega;
  module.attr("_time_limit") = *defaults.time_limit;
  module.attr("_replan_time_limit") = *Session::default_options().time_limit;
  module.def("default_threads", &default_threads,
             "Returns the number of cores that this process may use.");
  module.def("default_memory_limit", &default_memory_limit,
             "Returns 80 % of the memory of the machine, or of the limit of the container or batch "
             "system, in bytes.");
  module.def("_solve", [](const Instance& instance, const py::dict& arguments) {
    Call call(instance, arguments);
    return SolutionOfInstance::of(
        instance, run_on_search_thread(call, [&] { return solve(instance, call.options); }));
  });
}

}  // namespace grove::python
