// SPDX-License-Identifier: MIT
#include <vector>

#include "python/binding/solving.h"

namespace grove::python {
namespace {

// Converts a list of task dicts, in the format of *.cts.json files, by making an instance with
// these tasks and the session's agents.
std::vector<Task> tasks_of(const Session& session, const py::object& tasks) {
  const Instance now = session.instance();
  const py::object module = py::module_::import("grove");
  py::object agents = py::cast(now).attr("agents");
  for (const py::handle& agent : agents) agent.attr("pop")("working", py::none());
  return module.attr("Instance")(now.world(), agents, tasks).cast<const Instance&>().tasks();
}

// Converts each element of a list. `expected` describes an element in error messages.
template <class T>
std::vector<T> values_of(const py::object& list, const std::string& field,
                         const std::string& expected) {
  std::vector<T> values;
  for (const py::object& element : elements_of(list, field, "a list, each element " + expected))
    values.push_back(value_of<T>(element, field + "/" + std::to_string(values.size()), expected));
  return values;
}

void change(Session& session, const py::object& new_tasks, const py::object& dropped,
            const py::object& blocked) {
  Change change{
      .new_tasks = {},
      .dropped_tasks = values_of<std::string>(dropped, "/dropped_tasks", "the id of a task"),
      .blocked = values_of<Place>(blocked, "/blocked", kPlaceExpected)};
  if (py::len(new_tasks) > 0) change.new_tasks = tasks_of(session, new_tasks);
  session.change(change);
}

void advance(Session& session, const py::object& steps, const py::dict& late) {
  std::vector<Delay> all;
  for (const auto& [agent, by] : late)
    all.push_back({value_of<std::string>(agent, "/late", "ids of agents"),
                   value_of<int>(by, "/late", "a whole number of steps for each agent")});
  session.advance(value_of<int>(steps, "/steps", "a whole number"), all);
}

SolutionOfInstance replan(Session& session, int commit, const py::dict& arguments) {
  Call call(session.instance(), arguments);
  Solution solution =
      run_on_search_thread(call, [&] { return session.replan(call.options, commit); });
  return SolutionOfInstance::of(session.instance(), std::move(solution));
}

std::optional<PlanOfInstance> plan_of(const Session& session) {
  auto plan = session.plan();
  if (!plan) return std::nullopt;
  return PlanOfInstance{session.instance(), std::make_shared<const Plan>(*std::move(plan))};
}

}  // namespace

void add_session(py::module_& module) {
  py::class_<Session>(module, "_Session")
      .def(py::init<Instance>())
      .def(py::init([](const PlanOfInstance& plan) { return Session(plan.instance, *plan.plan); }))
      .def("instance", &Session::instance)
      .def("plan", &plan_of)
      .def("advance", &advance)
      .def("change", &change)
      .def("replan", &replan);
}

}  // namespace grove::python
