// SPDX-License-Identifier: MIT
#include "grove/io/order_file.h"

#include <map>
#include <nlohmann/json.hpp>

#include "json_writer.h"
#include "path_entry.h"

namespace grove {
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

// By action: the number of its ring, from 0; -1: of none.
std::vector<int> rings_of(const PassingOrder& order) {
  std::vector<int> rings(order.actions().size(), -1);
  int ring = 0;
  for (std::int32_t number = 0; number < order.step_count(); ++number) {
    if (order.step(number).size() == 1) continue;
    for (const ActionIndex a : order.step(number)) rings[a] = ring;
    ++ring;
  }
  return rings;
}

OrderedJson point_json(const Instance& instance, const Frame& frame, State state) {
  const Point at = metres(instance.map(), frame, instance.world().place(state));
  return {at.x, at.y};
}

// By robot: its tasks without duration that it has yet to come by.
using Visits = std::vector<std::multimap<Place, TaskIndex>>;

Visits visits_to_make(const Instance& instance) {
  Visits visits(instance.agent_count());
  for (TaskIndex t = 0; t < instance.task_count(); ++t) {
    const Task& task = instance.task(t);
    if (task.duration > 0) continue;
    for (const AgentIndex agent : task.agents) visits[agent].emplace(task.cell, t);
  }
  return visits;
}

// Tasks that the robot visits when it first is on the place.
void add_visits(OrderedJson& json, const Instance& instance, std::multimap<Place, TaskIndex>& left,
                State state) {
  const auto [begin, end] = left.equal_range(instance.world().place(state));
  for (auto task = begin; task != end; ++task)
    json["visits"].push_back(instance.task(task->second).id);
  left.erase(begin, end);
}

OrderedJson action_json(const Instance& instance, const PassingOrder& order, const Frame& frame,
                        ActionIndex index, int ring) {
  const Action& action = order.actions()[index];
  const Motion motion = instance.agent(action.agent).motion;
  OrderedJson json{{"do", name_of(action.kind)}};
  if (action.kind == Action::Kind::kWork)
    json["task"] = instance.task(action.task).id;
  else
    json["to"] = pose_json(instance.map(), motion, instance.pose_of(action.to));
  if (action.kind == Action::Kind::kMove) json["at"] = point_json(instance, frame, action.to);
  json["steps"] = action.steps;
  json["planned"] = action.begin;
  if (const ActionIndex other = order.after(index); other != kNoAction) {
    const AgentIndex robot = order.actions()[other].agent;
    json["after"] = {{"robot", instance.agent(robot).id},
                     {"action", other - order.begin_of(robot)}};
  }
  if (ring >= 0) json["ring"] = ring;
  return json;
}

}  // namespace

std::string order_text(const Instance& instance, const PassingOrder& order, const Frame& frame) {
  const std::vector<int> rings = rings_of(order);
  Visits visits = visits_to_make(instance);
  OrderedJson robots = OrderedJson::array();
  for (AgentIndex agent = 0; agent < order.agent_count(); ++agent) {
    const Agent& a = instance.agent(agent);
    OrderedJson robot{{"id", a.id},
                      {"start", pose_json(instance.map(), a.motion, instance.pose_of(a.start))},
                      {"at", point_json(instance, frame, a.start)}};
    add_visits(robot, instance, visits[agent], a.start);
    OrderedJson actions = OrderedJson::array();
    for (ActionIndex i = order.begin_of(agent); i < order.end_of(agent); ++i) {
      actions.push_back(action_json(instance, order, frame, i, rings[i]));
      add_visits(actions.back(), instance, visits[agent], order.actions()[i].to);
    }
    robot["actions"] = std::move(actions);
    robots.push_back(std::move(robot));
  }
  return dump_by_lines({{"format", "grove passing order 1"}, {"robots", std::move(robots)}});
}

}  // namespace grove
