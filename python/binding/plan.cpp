// SPDX-License-Identifier: MIT
#include <pybind11/numpy.h>

#include <cstdint>
#include <limits>
#include <unordered_map>
#include <vector>

#include "python/binding/values.h"

namespace grove::python {
namespace {

using Point = std::pair<double, double>;

// Coordinates of roadmap places, in metres, interpolated along straight roads.
class Metres {
 public:
  explicit Metres(const World& world) : edges_(world.edges()) {
    for (const RoadmapVertex& vertex : world.vertices()) at_[vertex.id] = {vertex.x, vertex.y};
  }
  Point operator()(const Place& place) const {
    if (const auto* vertex = std::get_if<Vertex>(&place)) return at_.at(vertex->id);
    const auto& road = std::get<OnRoad>(place);
    const auto [x, y] = at_.at(road.from);
    const auto [to_x, to_y] = at_.at(road.to);
    const double share = static_cast<double>(road.steps) / length(road);
    return {x + share * (to_x - x), y + share * (to_y - y)};
  }

 private:
  int length(const OnRoad& road) const {
    if (road.edge) return edges_[*road.edge].steps;
    for (const RoadmapEdge& edge : edges_)
      if ((edge.from == road.from && edge.to == road.to) ||
          (edge.from == road.to && edge.to == road.from))
        return edge.steps;
    throw Error("a robot is on a road that is not there");
  }

  std::vector<RoadmapEdge> edges_;
  std::unordered_map<std::string, Point> at_;
};

py::array cells(const Plan& plan) {
  const auto agents = static_cast<py::ssize_t>(plan.agents.size());
  const py::ssize_t times = plan.makespan() + 1;
  py::array_t<std::int32_t> all({agents, times, py::ssize_t{2}});
  auto at = all.mutable_unchecked<3>();
  for (py::ssize_t a = 0; a < agents; ++a)
    for (py::ssize_t t = 0; t < times; ++t) {
      const Cell cell = std::get<Cell>(plan.pose(a, static_cast<int>(t)).place);
      at(a, t, 0) = cell.x;
      at(a, t, 1) = cell.y;
    }
  return all;
}

py::array points(const Plan& plan, const World& world) {
  const Metres metres(world);
  const auto agents = static_cast<py::ssize_t>(plan.agents.size());
  const py::ssize_t times = plan.makespan() + 1;
  py::array_t<double> all({agents, times, py::ssize_t{2}});
  auto at = all.mutable_unchecked<3>();
  for (py::ssize_t a = 0; a < agents; ++a)
    for (py::ssize_t t = 0; t < times; ++t) {
      const Point point = metres(plan.pose(a, static_cast<int>(t)).place);
      at(a, t, 0) = point.first;
      at(a, t, 1) = point.second;
    }
  return all;
}

void require_paths(const Plan& plan) {
  for (std::size_t i = 0; i < plan.agents.size(); ++i)
    if (plan.agents[i].path.empty())
      throw InvalidArgument("/agents/" + std::to_string(i) + "/path", "is empty");
}

py::array positions(const PlanOfInstance& own) {
  require_paths(*own.plan);
  const World world = own.instance.world();
  return world.is_grid() ? cells(*own.plan) : points(*own.plan, world);
}

py::array headings(const PlanOfInstance& own) {
  const Plan& plan = *own.plan;
  require_paths(plan);
  const auto agents = static_cast<py::ssize_t>(plan.agents.size());
  const py::ssize_t times = plan.makespan() + 1;
  py::array_t<std::int8_t> all({agents, times});
  auto at = all.mutable_unchecked<2>();
  for (py::ssize_t a = 0; a < agents; ++a)
    for (py::ssize_t t = 0; t < times; ++t) {
      const auto heading = plan.pose(a, static_cast<int>(t)).heading;
      at(a, t) = heading ? static_cast<std::int8_t>(*heading) : std::int8_t{-1};
    }
  return all;
}

std::vector<Place> path_of(const AgentPlan& agent) {
  std::vector<Place> path;
  for (const Pose& pose : agent.path) path.push_back(pose.place);
  return path;
}

py::list work_of(const AgentPlan& agent) {
  py::list all;
  for (const Work& work : agent.work) all.append(py::make_tuple(work.task, work.begin, work.end));
  return all;
}

Work visit_of(const py::object& visit, const std::string& field) {
  constexpr const char* kExpected = "(task, begin, end)";
  const std::vector<py::object> parts = elements_of(visit, field, kExpected);
  if (parts.size() != 3)
    throw InvalidArgument(field, "found " + text_of_found(visit) + "; expected " + kExpected);
  return {value_of<std::string>(parts[0], field + "/0", "the id of a task"),
          value_of<int>(parts[1], field + "/1", "a whole number of steps"),
          value_of<int>(parts[2], field + "/2", "a whole number of steps")};
}

std::vector<std::vector<Work>> visits_of(const py::object& given) {
  std::vector<std::vector<Work>> all;
  for (const py::object& agent : elements_of(given, "/work", "a list of visits for each agent")) {
    const std::string field = "/work/" + std::to_string(all.size());
    std::vector<Work>& visits = all.emplace_back();
    for (const py::object& visit : elements_of(agent, field, "a list of (task, begin, end)"))
      visits.push_back(visit_of(visit, field + "/" + std::to_string(visits.size())));
  }
  return all;
}

PlanOfInstance from_paths(const Instance& instance, const py::object& given,
                          const py::object& work) {
  std::vector<std::vector<Place>> paths;
  for (const py::object& path :
       elements_of(given, "/paths", "a list of paths, one for each agent")) {
    const std::string field = "/paths/" + std::to_string(paths.size());
    std::vector<Place>& places = paths.emplace_back();
    for (const py::object& place : elements_of(path, field, "a list of places, one for each time"))
      places.push_back(
          value_of<Place>(place, field + "/" + std::to_string(places.size()), kPlaceExpected));
  }
  return {instance, std::make_shared<const Plan>(
                        work.is_none() ? plan_from_paths(instance, paths)
                                       : plan_from_paths(instance, paths, visits_of(work)))};
}

py::list violation_list(const std::vector<Violation>& violations) {
  py::list all;
  for (const Violation& v : violations) all.append(py::make_tuple(v.json_pointer, v.message));
  return all;
}

std::string solution_summary(const SolutionOfInstance& solution) {
  std::string text = "<grove.Solution: " + std::string(to_string(solution.facts.status));
  if (solution.plan) text += ", cost " + std::to_string(solution.plan->plan->cost);
  if (solution.facts.status == Status::infeasible) return text + ">";
  return text + ", lower bound " + std::to_string(solution.facts.lower_bound) + ">";
}

SolutionOfInstance unclaimed(const PlanOfInstance& plan) {
  return {plan.instance,
          {.status = plan.plan->cost == 0 ? Status::optimal : Status::feasible,
           .omega = std::numeric_limits<double>::infinity()},
          plan};
}

std::optional<double> gap_of(const SolutionOfInstance& solution) {
  return solution.whole().gap();
}

void add_agent_plan(py::module_& module) {
  py::class_<AgentPlan>(module, "AgentPlan", "Path, visits and task executions of one robot.")
      .def_readonly("id", &AgentPlan::id, "Id of the agent.")
      .def_readonly("cost", &AgentPlan::cost,
                    "Finish time in steps: from then on the robot rests, with all its tasks done.")
      .def_property_readonly("path", &path_of, "Places at times 0, 1, ..., cost.")
      .def_readonly("tasks", &AgentPlan::tasks,
                    "Ids of the tasks that the robot visits, in order of completion.")
      .def_property_readonly(
          "work", &work_of,
          "Visits that the plan states, as [(task, begin, end), ...], in steps: executions of "
          "tasks "
          "with a duration, and visits to tasks that only some of their agents must visit.")
      .def("__repr__", [](const AgentPlan& agent) {
        return "<grove.AgentPlan: " + agent.id + ", cost " + std::to_string(agent.cost) + ">";
      });
}

}  // namespace

void add_plan(py::module_& module) {
  add_agent_plan(module);
  py::class_<PlanOfInstance>(
      module, "Plan",
      "A path for every robot of an instance. Immutable.\n\n"
      "Plan(instance, paths): from lists of places, or an array of agents x times "
      "x 2; costs and orders of visits are computed.\n\n"
      "Plan(instance, paths, work): with the visits that the plan states, for each agent a list of "
      "(task, begin, end); see AgentPlan.work.")
      .def(py::init(&from_paths), py::arg("instance"), py::arg("paths"),
           py::arg("work") = py::none())
      .def_property_readonly(
          "instance", [](const PlanOfInstance& p) { return p.instance; },
          "The instance of the plan.")
      .def_property_readonly(
          "cost", [](const PlanOfInstance& p) { return p.plan->cost; },
          "Sum of the costs of all agents.")
      .def_property_readonly(
          "makespan", [](const PlanOfInstance& p) { return p.plan->makespan(); },
          "Time step from which on all robots rest.")
      .def_property_readonly(
          "agents", [](const PlanOfInstance& p) { return p.plan->agents; },
          "AgentPlans, in the order of the instance.")
      .def("positions", &positions,
           "Returns an array of agents x times x 2: cells (x, y) on a grid, metres on a roadmap.")
      .def("headings", &headings,
           "Returns an array of agents x times: 0 north, 1 east, 2 south, 3 west; -1 for an agent "
           "without "
           "headings.")
      .def("__repr__", [](const PlanOfInstance& p) {
        return "<grove.Plan: " + std::to_string(p.plan->agents.size()) + " agents, cost " +
               std::to_string(p.plan->cost) + ">";
      });
  py::class_<SolutionOfInstance>(
      module, "Solution",
      "Result of a solve: status, lower bound and, if found, a plan. Immutable.\n\n"
      "Solution(plan): a plan without claims.")
      .def(py::init(&unclaimed), py::arg("plan"))
      .def_property_readonly(
          "instance", [](const SolutionOfInstance& s) { return s.instance; },
          "The instance that was solved.")
      .def_property_readonly(
          "status",
          [](const SolutionOfInstance& s) { return std::string(to_string(s.facts.status)); },
          "'optimal', 'bounded' (within omega), 'feasible', 'infeasible' or 'unknown'.")
      .def_readonly("plan", &SolutionOfInstance::plan, "The plan; None if none was found.")
      .def_property_readonly(
          "lower_bound", [](const SolutionOfInstance& s) { return s.facts.lower_bound; },
          "Proven lower bound on the cost of every plan.")
      .def_property_readonly(
          "omega", [](const SolutionOfInstance& s) { return s.facts.omega; },
          "Relative tolerance of the solve.")
      .def_property_readonly(
          "following", [](const SolutionOfInstance& s) { return s.facts.following; },
          "False: bound and status hold for plans without following conflicts.")
      .def_property_readonly(
          "gap", &gap_of,
          "(cost - lower_bound) / lower_bound; 0.02 is 2 %. None without a plan, "
          "or if only the bound is 0.")
      .def_property_readonly(
          "counts", [](const SolutionOfInstance& s) { return s.facts.counts; },
          "Integer statistics of the search, as in the plan file, such as nodes_expanded.")
      .def_property_readonly(
          "measures", [](const SolutionOfInstance& s) { return s.facts.measures; },
          "Real-valued statistics, such as wall_s.")
      .def_property_readonly(
          "texts", [](const SolutionOfInstance& s) { return s.facts.texts; },
          "Text statistics, such as stopped_by (the limit that was reached) and reason (why there "
          "is "
          "no plan).")
      .def(
          "write",
          [](const SolutionOfInstance& s, const std::filesystem::path& path) {
            write_plan(path, s.instance, s.whole());
          },
          py::arg("path"),
          "Writes a plan file. Raises InvalidArgument if check() finds a violation.")
      .def("__repr__", &solution_summary);
  py::implicitly_convertible<PlanOfInstance, SolutionOfInstance>();
  module.def("_check_plan", [](const PlanOfInstance& plan, std::size_t limit) {
    return violation_list(check(plan.instance, *plan.plan, limit));
  });
  module.def("_check_solution", [](const SolutionOfInstance& solution, std::size_t limit) {
    return violation_list(check(solution.instance, solution.whole(), limit));
  });
  module.def(
      "fix_choices",
      [](const PlanOfInstance& plan) {
        FixedChoices fixed = fix_choices(plan.instance, *plan.plan);
        return PlanOfInstance{std::move(fixed.instance),
                              std::make_shared<const Plan>(std::move(fixed.plan))};
      },
      py::arg("plan"),
      "Returns the plan as a plan of an instance without choices: a robot must visit the tasks "
      "that "
      "it visits in `plan`, and its destination is the goal on which it ends. Paths and cost stay "
      "the same. Raises InvalidArgument if the plan is not valid.");
  module.def(
      "read_plan",
      [](const std::filesystem::path& path, const Instance& instance) {
        return SolutionOfInstance::of(instance, read_plan(path, instance));
      },
      py::arg("path"), py::arg("instance"),
      "Reads a plan file of this instance without checking its claims; check() checks them.");
}

}  // namespace grove::python
