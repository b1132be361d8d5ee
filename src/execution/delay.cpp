// SPDX-License-Identifier: MIT
// Proof that the plan is valid.
//
// Claim: no two robots collide. Proof: an action begins no earlier than the action on which it
// depends, and moves take one time step. Therefore robots pass each place in the order of `plan`,
// and no robot arrives on a place before the previous one has left it. (Dependencies that were
// removed as transitive hold as well, because begin times never fall along the remaining ones.)
// Hence no two robots are on one place at the same time. If two robots swapped places, each would
// enter a place directly after the other one, so their moves would depend on each other. Then they
// would be a ring of two moves in `plan`, which is a swap, but `plan` has none.
//
// Without following, an action begins only when the action on which it depends has ended, as in an
// execution (execution_trace.h). Therefore a robot arrives on a place at least one step after the
// previous robot has left it. A plan without following has no rings, so these waits are acyclic
// (action_dependency_graph.cpp). They do not delay a plan in which no robot is late, because in
// that plan each action waits at least as long.
#include "execution/delay.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "model/assert.h"

namespace grove::detail {
namespace {

// The earliest begin time of each action, without regard to other robots.
class EarliestTimes {
 public:
  EarliestTimes(const ActionDependencyGraph& order, Time time, std::span<const Delay> late)
      : order_(order), time_(time), late_(static_cast<std::size_t>(order.agent_count())) {
    for (const Delay& l : late) late_[l.agent] = l.steps;
  }

  Time begin(ActionIndex index) const {
    const Action& action = order_.actions()[index];
    if (is_done(action)) return action.begin;
    return is_under_way(action) ? action.begin + late_[action.agent] : time_;
  }
  // True if the action cannot begin after begin(), because the robot is late and is known to have
  // begun the action by then.
  bool is_certain(ActionIndex index) const {
    const Action& action = order_.actions()[index];
    return late_[action.agent] > 0 && (is_done(action) || is_under_way(action));
  }

 private:
  Time clock(const Action& action) const { return time_ - late_[action.agent]; }
  bool is_done(const Action& action) const { return action.begin + action.steps <= clock(action); }
  // True if the robot has begun the action but not completed it at time_.
  bool is_under_way(const Action& action) const {
    return action.begin < clock(action) && !is_done(action);
  }

  const ActionDependencyGraph& order_;
  const Time time_;
  std::vector<Time> late_;  // by agent
};

[[noreturn]] void refuse(const Instance& instance, const ActionDependencyGraph& order,
                         ActionIndex index, Time time) {
  const Action& action = order.actions()[index];
  const ActionIndex other = order.after(index);
  const std::string before =
      other == kNoAction ? "others"
                         : fmt::format("'{}'", instance.agent(order.actions()[other].agent).id);
  throw InfeasibleDelay(
      action.agent,
      fmt::format("'{}' cannot have reached {} by step {}, because {} had not left it",
                  instance.agent(action.agent).id, instance.world().name(action.to), time, before));
}

void require_possible(const Instance& instance, Time time, std::span<const Delay> late) {
  for (const Delay& l : late) {
    const std::string& id = instance.agent(l.agent).id;
    if (l.steps > time)
      throw InfeasibleDelay(
          l.agent, fmt::format("'{}' cannot be {} steps late; expected at most {}, the steps that "
                               "have passed",
                               id, l.steps, time));
    if (std::ranges::count(late, l.agent, &Delay::agent) > 1)
      throw InfeasibleDelay(l.agent,
                            fmt::format("'{}' is named twice; expected each robot once", id));
  }
}

// Moves the task execution that is in progress at the start by the robot's delay. In every plan of
// an instance, such an execution continues at time 0; for a late robot it does not.
void delay_work_begun_before(const Instance& instance, std::span<const Delay> late, Plan& plan) {
  for (const Delay& l : late) {
    if (!instance.world().is_working(instance.agent(l.agent).start)) continue;
    AgentPlan& robot = plan.agents[l.agent];
    GROVE_CHECK(
        !robot.work.empty() &&
            robot.work.front().task == instance.world().work(instance.agent(l.agent).start).task,
        "a robot that starts at work completes this work first");
    WorkTime& work = robot.work.front();
    work.begin += l.steps;
    work.end += l.steps;
    const Time cost = std::max(robot.cost, work.end);
    plan.cost += cost - robot.cost;
    robot.cost = cost;
    robot.path.resize(static_cast<std::size_t>(cost) + 1, robot.path.back());
  }
}

}  // namespace

Plan delayed_plan(const Instance& instance, const Plan& plan, const ActionDependencyGraph& order,
                  Time time, std::span<const Delay> late) {
  require_possible(instance, time, late);
  const EarliestTimes earliest(order, time, late);
  ExecutionTrace trace{std::vector<Time>(order.actions().size()),
                       std::vector<Time>(order.actions().size())};
  for (std::int32_t number = 0; number < order.step_count(); ++number) {
    Time begin = 0;
    for (const ActionIndex a : order.step(number)) {
      begin = std::max(begin, earliest.begin(a));
      if (order.before(a) != kNoAction) begin = std::max(begin, trace.end[order.before(a)]);
      if (const ActionIndex other = order.after(a); other != kNoAction)
        begin = std::max(begin, instance.may_follow() ? trace.begin[other] : trace.end[other]);
    }
    for (const ActionIndex a : order.step(number)) {
      if (earliest.is_certain(a) && begin > earliest.begin(a)) refuse(instance, order, a, time);
      GROVE_ASSERT(order.before(a) == kNoAction || trace.end[order.before(a)] <= begin,
                   "a robot completes an action before it begins the next");
      trace.begin[a] = begin;
      trace.end[a] = begin + order.actions()[a].steps;
    }
  }
  Plan executed = executed_plan(instance, plan, order, trace);
  delay_work_begun_before(instance, late, executed);
  return executed;
}

}  // namespace grove::detail
