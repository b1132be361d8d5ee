// SPDX-License-Identifier: MIT
#include "execution/execution_trace.h"

#include <algorithm>
#include <stdexcept>

namespace grove::detail {
namespace {

Time end_of(const ExecutionTrace& drive, ActionIndex action) {
  return action == kNoAction ? 0 : drive.end[action];
}

Time may_begin(const ActionDependencyGraph& order, const ExecutionTrace& drive,
               ActionIndex action) {
  return std::max(end_of(drive, order.before(action)), end_of(drive, order.after(action)));
}

// Appends an action that is completed at `end` to the executed plan of a robot, with a wait before
// it if necessary.
void add_action(const Instance& instance, const AgentPlan& planned, const Action& action, Time end,
                AgentPlan& driven) {
  Path& path = driven.path;
  const Time begin = end - action.steps;
  path.resize(static_cast<std::size_t>(begin) + 1, path.back());
  if (action.kind == Action::Kind::kWork) {
    const Time duration = instance.task(action.task).duration;
    // In every plan of the instance, a task execution that is in progress at the start continues at
    // time 0. Therefore its delay becomes a wait after it.
    const bool is_begun =
        driven.work.empty() && instance.world().is_working(instance.agent(action.agent).start);
    const Time done = is_begun ? action.steps : end;
    driven.work.push_back({action.task, done - duration, done});
    path.resize(static_cast<std::size_t>(done) + 1, path.back());
  } else if (action.kind == Action::Kind::kMove) {
    path.push_back(action.to);
  } else {
    const auto from = planned.path.begin() + action.begin;
    // Appends the planned states of the turn, without waits between them.
    for (auto state = from + 1; path.back() != action.to; ++state)
      if (*state != path.back()) path.push_back(*state);
  }
}

// Returns the robot for which the robots of a step wait. All robots of a ring wait for the same
// one.
AgentIndex waits_for(const ActionDependencyGraph& order, const ExecutionTrace& drive,
                     std::int32_t step) {
  for (const ActionIndex a : order.step(step)) {
    const AgentIndex self = order.actions()[a].agent;
    if (drive.begin[a] < kNever && drive.end[a] == kNever) return self;
    const ActionIndex other = order.after(a);
    if (other != kNoAction && drive.end[other] == kNever) return order.actions()[other].agent;
    if (end_of(drive, order.before(a)) == kNever) return self;
  }
  return -1;
}

}  // namespace

// kNever is reserved for actions that are never completed.
Time end_of_action(Time begin, Time duration) {
  if (duration >= kNever) return kNever;
  if (duration >= kNever - begin) throw std::overflow_error("the execution takes too many steps");
  return begin + duration;
}

ExecutionTrace drive(const ActionDependencyGraph& order, const Duration& duration) {
  ExecutionTrace drive{std::vector<Time>(order.actions().size(), kNever),
                       std::vector<Time>(order.actions().size(), kNever)};
  for (std::int32_t number = 0; number < order.step_count(); ++number) {
    Time begin = 0;
    for (const ActionIndex a : order.step(number))
      begin = std::max(begin, may_begin(order, drive, a));
    if (begin == kNever) continue;
    Time end = begin;
    for (const ActionIndex a : order.step(number))
      end = std::max(end, end_of_action(begin, duration(a, begin)));
    for (const ActionIndex a : order.step(number)) {
      drive.begin[a] = begin;
      drive.end[a] = end;
    }
  }
  return drive;
}

ExecutionTrace simulate_nominal(const ActionDependencyGraph& order) {
  return drive(order, [&](ActionIndex a, Time) { return order.actions()[a].steps; });
}

Plan executed_plan(const Instance& instance, const Plan& plan, const ActionDependencyGraph& order,
                   const ExecutionTrace& drive) {
  Plan driven;
  for (AgentIndex agent = 0; agent < order.agent_count(); ++agent) {
    AgentPlan robot{.sequence = plan.agents[agent].sequence,
                    .path = {plan.agents[agent].path.front()}};
    for (ActionIndex a = order.begin_of(agent); a < order.end_of(agent); ++a) {
      if (drive.end[a] == kNever) break;
      add_action(instance, plan.agents[agent], order.actions()[a], drive.end[a], robot);
    }
    robot.cost = static_cast<Time>(robot.path.size()) - 1;
    driven.cost += robot.cost;
    driven.agents.push_back(std::move(robot));
  }
  return driven;
}

std::vector<BlockedRobot> stuck(const ActionDependencyGraph& order, const ExecutionTrace& drive) {
  std::vector<BlockedRobot> stuck;
  std::vector<bool> is_listed(static_cast<std::size_t>(order.agent_count()));
  for (std::int32_t number = 0; number < order.step_count(); ++number) {
    for (const ActionIndex a : order.step(number)) {
      const AgentIndex agent = order.actions()[a].agent;
      if (drive.end[a] < kNever || is_listed[agent]) continue;
      is_listed[agent] = true;
      stuck.push_back({agent, waits_for(order, drive, number)});
    }
  }
  return stuck;
}

}  // namespace grove::detail
