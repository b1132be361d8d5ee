// SPDX-License-Identifier: MIT
#include <map>
#include <vector>

#include "python/binding/solving.h"

namespace grove::python {
namespace {

// Tasks are told as in files; what is read is another instance, with these alone.
std::vector<Task> tasks_of(const Session& session, const py::object& tasks) {
  const Instance now = session.instance();
  const py::object module = py::module_::import("grove");
  py::object agents = py::cast(now).attr("agents");
  for (const py::handle& agent : agents) agent.attr("pop")("working", py::none());
  return module.attr("Instance")(now.world(), agents, tasks).cast<const Instance&>().tasks();
}

void change(Session& session, const py::object& new_tasks, std::vector<std::string> dropped,
            std::vector<Place> blocked) {
  session.change({.new_tasks = py::len(new_tasks) > 0 ? tasks_of(session, new_tasks)
                                                      : std::vector<Task>{},
                  .dropped_tasks = std::move(dropped),
                  .blocked = std::move(blocked)});
}

void advance(Session& session, int steps, const std::map<std::string, int>& late) {
  std::vector<Late> all;
  for (const auto& [agent, by] : late) all.push_back({agent, by});
  session.advance(steps, all);
}

OwnSolution replan(Session& session, int commit, const py::dict& arguments) {
  Call call(session.instance(), arguments);
  Solution solution =
      run_aside(call, [&] { return session.replan(call.options, commit); });
  return OwnSolution::of(session.instance(), std::move(solution));
}

std::optional<OwnPlan> plan_of(const Session& session) {
  auto plan = session.plan();
  if (!plan) return std::nullopt;
  return OwnPlan{session.instance(), std::make_shared<const Plan>(*std::move(plan))};
}

}  // namespace

void add_session(py::module_& module) {
  py::class_<Session>(module, "_Session")
      .def(py::init<Instance>())
      .def(py::init([](const OwnPlan& plan) { return Session(plan.instance, *plan.plan); }))
      .def("instance", &Session::instance)
      .def("plan", &plan_of)
      .def("advance", &advance)
      .def("change", &change)
      .def("replan", &replan);
}

}  // namespace grove::python
