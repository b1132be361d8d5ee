// SPDX-License-Identifier: MIT
#include "io/passing_order_file.h"

#include <nlohmann/json.hpp>

#include "execution/action_dependency_graph.h"
#include "io/json_text.h"
#include "io/path_entry.h"
#include "model/assert.h"

namespace grove::detail {
namespace {

using OrderedJson = nlohmann::ordered_json;

const char* name_of(Action::Kind kind) {
  switch (kind) {
    case Action::Kind::kMove:
      return "move";
    case Action::Kind::kTurn:
      return "turn";
    case Action::Kind::kWork:
      break;
  }
  return "work";
}

// By action: the number of its ring, from 0; -1: not in a ring.
std::vector<int> rings_of(const ActionDependencyGraph& order) {
  std::vector<int> rings(order.actions().size(), -1);
  int ring = 0;
  for (std::int32_t number = 0; number < order.step_count(); ++number) {
    if (order.step(number).size() == 1) continue;
    for (const ActionIndex a : order.step(number)) rings[a] = ring;
    ++ring;
  }
  GROVE_CHECK(ring == order.rings(), "each ring has a number");
  return rings;
}

OrderedJson point_json(const Instance& instance, const Frame& frame, State state) {
  const Point at = metres(instance.map(), frame, instance.world().place(state));
  return {at.x, at.y};
}

// The begin time of the action in the plan; negative for a task execution that was in progress at
// the start.
Time planned_begin(const Instance& instance, const ActionDependencyGraph& order,
                   ActionIndex index) {
  const Action& action = order.actions()[index];
  const State start = instance.agent(action.agent).start;
  const bool starts_at_it = index == order.begin_of(action.agent) &&
                            action.kind == Action::Kind::kWork &&
                            instance.world().is_working(start);
  return starts_at_it ? -instance.world().work(start).done : action.begin;
}

OrderedJson action_json(const Instance& instance, const ActionDependencyGraph& order,
                        const Frame& frame, ActionIndex index, int ring) {
  const Action& action = order.actions()[index];
  const Motion motion = instance.agent(action.agent).motion;
  OrderedJson json{{"do", name_of(action.kind)}};
  if (action.kind == Action::Kind::kWork)
    json["task"] = instance.task(action.task).id;
  else
    json["to"] = pose_json(instance.map(), motion, instance.pose_of(action.to));
  if (action.kind == Action::Kind::kMove) json["at"] = point_json(instance, frame, action.to);
  json["steps"] = action.steps;
  json["planned"] = planned_begin(instance, order, index);
  if (const ActionIndex other = order.after(index); other != kNoAction) {
    const AgentIndex robot = order.actions()[other].agent;
    GROVE_CHECK(robot != action.agent, "a robot waits for actions of other robots only");
    json["after"] = {{"robot", instance.agent(robot).id},
                     {"action", other - order.begin_of(robot)}};
  }
  if (ring >= 0) json["ring"] = ring;
  return json;
}

}  // namespace

std::string passing_order_text(const Instance& instance, const ActionDependencyGraph& order,
                               const Frame& frame) {
  const std::vector<int> rings = rings_of(order);
  const std::vector<std::vector<TaskVisit>> visits = task_visits(instance, order);
  OrderedJson robots = OrderedJson::array();
  for (AgentIndex agent = 0; agent < order.agent_count(); ++agent) {
    const Agent& a = instance.agent(agent);
    OrderedJson robot{{"id", a.id},
                      {"start", pose_json(instance.map(), a.motion, instance.pose_of(a.start))},
                      {"at", point_json(instance, frame, a.start)}};
    OrderedJson actions = OrderedJson::array();
    for (ActionIndex i = order.begin_of(agent); i < order.end_of(agent); ++i)
      actions.push_back(action_json(instance, order, frame, i, rings[i]));
    for (const TaskVisit& visit : visits[agent]) {
      const Task& task = instance.task(visit.task);
      if (task.duration > 0) continue;  // its action names the task
      const bool is_at_start = visit.action == kNoAction;
      GROVE_CHECK(is_at_start ||
                      (visit.action >= order.begin_of(agent) && visit.action < order.end_of(agent)),
                  "an agent visits a task by one of its own actions");
      (is_at_start ? robot : actions[visit.action - order.begin_of(agent)])["visits"].push_back(
          task.id);
    }
    robot["actions"] = std::move(actions);
    robots.push_back(std::move(robot));
  }
  return dump_by_lines({{"format", "grove passing order 1"}, {"robots", std::move(robots)}});
}

}  // namespace grove::detail
