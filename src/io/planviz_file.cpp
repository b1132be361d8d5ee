// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "io/atomic_file.h"
#include "io/format_support.h"
#include "io/json_text.h"
#include "io/plan_export.h"
#include "io/plan_steps.h"
#include "model/assert.h"

namespace grove::detail {
namespace {

using OrderedJson = nlohmann::ordered_json;

bool turns(const Instance& instance) {
  return instance.agent(0).motion.turn_steps > 0;
}

void require_expressible(const Instance& instance) {
  if (!instance.is_on_grid())
    throw NotRepresentable("roadmap", "PlanViz cannot show a roadmap; expected a grid",
                           Loss::kNothing);
  for (AgentIndex i = 0; i < instance.agent_count(); ++i) {
    const Time steps = instance.agent(i).motion.turn_steps;
    if (steps > 1 || (steps > 0) != turns(instance))
      throw NotRepresentable(
          fmt::format("agents/{}", i),
          fmt::format("agent '{}' takes {} steps for a quarter turn; PlanViz requires 1 step for "
                      "all agents, or agents that turn freely",
                      instance.agent(i).id, steps),
          Loss::kNothing);
  }
}

char action(const Grid& grid, const Pose& from, const Pose& to, bool is_turning) {
  if (from == to) return 'W';
  if (is_turning) {
    if (from.place != to.place) return 'F';
    GROVE_CHECK(to.heading == right_of(from.heading) || to.heading == left_of(from.heading),
                "an agent turns by one quarter per step");
    return to.heading == right_of(from.heading) ? 'R' : 'C';
  }
  const Position a = grid.position(from.place);
  const Position b = grid.position(to.place);
  GROVE_CHECK(std::abs(a.x - b.x) + std::abs(a.y - b.y) == 1, "an agent moves to an adjacent cell");
  if (a.y != b.y) return b.y > a.y ? 'U' : 'D';
  return b.x > a.x ? 'R' : 'L';
}

std::string actions(const Instance& instance, const AgentPlan& plan, Time end) {
  std::string text;
  for (Time t = 0; t < end; ++t) {
    if (t > 0) text += ',';
    text += action(instance.grid(), instance.pose_of(state_at(plan.path, t)),
                   instance.pose_of(state_at(plan.path, t + 1)), turns(instance));
  }
  return text;
}

OrderedJson start_json(const Instance& instance, AgentIndex agent) {
  const Pose pose = instance.pose_of(instance.agent(agent).start);
  const Position p = instance.grid().position(pose.place);
  return {p.y, p.x, std::string(1, turns(instance) ? letter(pose.heading) : 'E')};
}

// An agent's errands as cells [row, column], and the time at which each is completed.
struct Errands {
  OrderedJson cells = OrderedJson::array();
  std::vector<Time> times;

  Errands(const Instance& instance, AgentIndex agent, const AgentPlan& plan)
      : times(visit_times(instance, plan)) {
    for (const TaskIndex task : plan.sequence) add(instance, instance.task(task).cell);
    if (instance.agent(agent).has_destination()) {
      add(instance, instance.world().place(plan.path.back()));
      times.push_back(plan.cost);
    }
  }
  void add(const Instance& instance, Place place) {
    const Position p = instance.grid().position(place);
    cells.push_back(p.y);
    cells.push_back(p.x);
  }
};

}  // namespace

void write_planviz(const std::filesystem::path& path, const Instance& instance,
                   const Solution& solution) {
  require_expressible(instance);
  const Plan& plan = *solution.plan;
  const Time end = makespan(plan);
  OrderedJson starts = OrderedJson::array();
  OrderedJson paths = OrderedJson::array();
  OrderedJson tasks = OrderedJson::array();
  OrderedJson schedules = OrderedJson::array();
  std::vector<std::array<std::int64_t, 4>> events;
  for (AgentIndex agent = 0; agent < instance.agent_count(); ++agent) {
    starts.push_back(start_json(instance, agent));
    paths.push_back(actions(instance, plan.agents[agent], end));
    const Errands errands(instance, agent, plan.agents[agent]);
    schedules.push_back(errands.times.empty() ? "" : fmt::format("0:{}", tasks.size()));
    if (errands.times.empty()) continue;
    for (std::size_t i = 0; i < errands.times.size(); ++i)
      events.push_back({errands.times[i], agent, static_cast<std::int64_t>(tasks.size()),
                        static_cast<std::int64_t>(i) + 1});
    tasks.push_back({tasks.size(), 0, errands.cells});
  }
  std::ranges::sort(events);
  const OrderedJson document{{"actionModel", turns(instance) ? "MAPF_T" : "MAPF"},
                             {"version", "2024 LoRR"},
                             {"AllValid", "Yes"},
                             {"teamSize", instance.agent_count()},
                             {"start", starts},
                             {"numTaskFinished", tasks.size()},
                             {"sumOfCost", plan.cost},
                             {"makespan", end},
                             {"actualPaths", paths},
                             {"plannerPaths", paths},
                             {"plannerTimes", OrderedJson::array()},
                             {"errors", OrderedJson::array()},
                             {"actualSchedule", schedules},
                             {"plannerSchedule", schedules},
                             {"scheduleErrors", OrderedJson::array()},
                             {"events", events},
                             {"tasks", tasks}};
  write_file_atomically(path, dump_by_lines(document));
}

}  // namespace grove::detail
