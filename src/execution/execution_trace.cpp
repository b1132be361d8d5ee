// SPDX-License-Identifier: MIT
#include "execution/execution_trace.h"

#include <algorithm>
#include <stdexcept>

#include "model/assert.h"

namespace grove::detail {
namespace {

Time end_of(const ExecutionTrace& trace, ActionIndex action) {
  return action == kNoAction ? 0 : trace.end[action];
}

Time may_begin(const ActionDependencyGraph& order, const ExecutionTrace& trace,
               ActionIndex action) {
  return std::max(end_of(trace, order.before(action)), end_of(trace, order.after(action)));
}

// Appends an action that is completed at `end` to the executed plan of a robot, with a wait before
// it if necessary.
void add_action(const Instance& instance, const AgentPlan& planned, const Action& action, Time end,
                AgentPlan& executed) {
  Path& path = executed.path;
  const Time begin = end - action.steps;
  GROVE_CHECK(begin + 1 >= std::ssize(path),
              "a robot begins an action after it has completed the one before");
  path.resize(static_cast<std::size_t>(begin) + 1, path.back());
  if (action.kind == Action::Kind::kWork) {
    const Time duration = instance.task(action.task).duration;
    // In every plan of the instance, a task execution that is in progress at the start continues at
    // time 0. Therefore its delay becomes a wait after it.
    const bool is_begun =
        executed.work.empty() && instance.world().is_working(instance.agent(action.agent).start);
    const Time done = is_begun ? action.steps : end;
    executed.work.push_back({action.task, done - duration, done});
    path.resize(static_cast<std::size_t>(done) + 1, path.back());
  } else if (action.kind == Action::Kind::kMove) {
    path.push_back(action.to);
  } else {
    const auto from = planned.path.begin() + action.begin;
    // Appends the planned states of the turn, without waits between them.
    for (auto state = from + 1; path.back() != action.to; ++state) {
      GROVE_CHECK(state != planned.path.end(), "a planned turn leads to its last state");
      if (*state != path.back()) path.push_back(*state);
    }
  }
  GROVE_CHECK(action.kind == Action::Kind::kWork || std::ssize(path) == end + 1,
              "after a move or turn the path ends when the action ends");
}

// Returns the robot for which the robots of a step wait. All robots of a ring wait for the same
// one.
AgentIndex waits_for(const ActionDependencyGraph& order, const ExecutionTrace& trace,
                     std::int32_t step) {
  for (const ActionIndex a : order.step(step)) {
    const AgentIndex self = order.actions()[a].agent;
    if (trace.begin[a] < kNever && trace.end[a] == kNever) return self;
    const ActionIndex other = order.after(a);
    if (other != kNoAction && trace.end[other] == kNever) return order.actions()[other].agent;
    if (end_of(trace, order.before(a)) == kNever) return self;
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

ExecutionTrace simulate(const ActionDependencyGraph& order, const Duration& duration) {
  ExecutionTrace trace{std::vector<Time>(order.actions().size(), kNever),
                       std::vector<Time>(order.actions().size(), kNever)};
  for (std::int32_t number = 0; number < order.step_count(); ++number) {
    Time begin = 0;
    for (const ActionIndex a : order.step(number)) {
      GROVE_ASSERT(trace.begin[a] == kNever, "an action is executed once");
      begin = std::max(begin, may_begin(order, trace, a));
    }
    if (begin == kNever) continue;
    Time end = begin;
    for (const ActionIndex a : order.step(number))
      end = std::max(end, end_of_action(begin, duration(a, begin)));
    for (const ActionIndex a : order.step(number)) {
      trace.begin[a] = begin;
      trace.end[a] = end;
    }
  }
  return trace;
}

ExecutionTrace simulate_nominal(const ActionDependencyGraph& order) {
  return simulate(order, [&](ActionIndex a, Time) { return order.actions()[a].steps; });
}

Plan executed_plan(const Instance& instance, const Plan& plan, const ActionDependencyGraph& order,
                   const ExecutionTrace& trace) {
  Plan executed;
  for (AgentIndex agent = 0; agent < order.agent_count(); ++agent) {
    AgentPlan robot{.sequence = plan.agents[agent].sequence,
                    .path = {plan.agents[agent].path.front()}};
    for (ActionIndex a = order.begin_of(agent); a < order.end_of(agent); ++a) {
      if (trace.end[a] == kNever) break;
      add_action(instance, plan.agents[agent], order.actions()[a], trace.end[a], robot);
    }
    GROVE_ASSERT(robot.work.size() <= plan.agents[agent].work.size(),
                 "a robot executes no task that is not in its plan");
    robot.cost = static_cast<Time>(robot.path.size()) - 1;
    executed.cost += robot.cost;
    executed.agents.push_back(std::move(robot));
  }
  return executed;
}

std::vector<BlockedRobot> blocked_robots(const ActionDependencyGraph& order,
                                         const ExecutionTrace& trace) {
  std::vector<BlockedRobot> blocked_robots;
  std::vector<bool> is_listed(static_cast<std::size_t>(order.agent_count()));
  for (std::int32_t number = 0; number < order.step_count(); ++number) {
    for (const ActionIndex a : order.step(number)) {
      const AgentIndex agent = order.actions()[a].agent;
      if (trace.end[a] < kNever || is_listed[agent]) continue;
      is_listed[agent] = true;
      blocked_robots.push_back({agent, waits_for(order, trace, number)});
    }
  }
  return blocked_robots;
}

}  // namespace grove::detail
