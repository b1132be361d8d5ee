// SPDX-License-Identifier: MIT
// Why the plan is valid. Every place is passed by the robots in the order of `plan`, each coming to
// it no sooner than the one before has gone: an action begins no sooner than that which it waits
// for, both moves taking one step. (Waits left out of the order as transitive hold all the same,
// for along the others begins never fall.) So no two are on one place at one time. Two that swapped
// places would each come to a place after the other there: in `plan`, too, their moves would have
// to be one step, a swap.
// Where no agent may follow another, an action waits until the other one has ended, as robots do
// when they drive (drive.h): it enters a place one step after the other has left it, or later. Such
// a plan has no rings, so these waits do not go in circles either (passing_order.cpp); and with
// no robot late it stays as it is, for its own actions wait as long.
#include "execution/late.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace grove::detail {
namespace {

// When actions would begin if nobody were in the way.
class Wishes {
 public:
  Wishes(const ActionDependencyGraph& order, Time time, std::span<const Late> late)
      : order_(order), time_(time), late_(static_cast<std::size_t>(order.agent_count())) {
    for (const Late& l : late) late_[l.agent] = l.steps;
  }

  Time begin(ActionIndex index) const {
    const Action& action = order_.actions()[index];
    if (is_done(action)) return action.begin;
    return is_under_way(action) ? action.begin + late_[action.agent] : time_;
  }
  // Must it have begun just then?
  bool is_certain(ActionIndex index) const {
    const Action& action = order_.actions()[index];
    return late_[action.agent] > 0 && (is_done(action) || is_under_way(action));
  }

 private:
  Time clock(const Action& action) const { return time_ - late_[action.agent]; }
  bool is_done(const Action& action) const { return action.begin + action.steps <= clock(action); }
  // The robot stood still within it.
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
  throw ImpossibleLateness(
      action.agent,
      fmt::format("'{}' cannot have come to {} by step {}, for {} had not left it",
                  instance.agent(action.agent).id, instance.world().name(action.to), time, before));
}

void require_possible(const Instance& instance, Time time, std::span<const Late> late) {
  for (const Late& l : late) {
    const std::string& id = instance.agent(l.agent).id;
    if (l.steps > time)
      throw ImpossibleLateness(
          l.agent, fmt::format("'{}' cannot be {} steps late; expected at most {}, the steps that "
                               "have passed",
                               id, l.steps, time));
    if (std::ranges::count(late, l.agent, &Late::agent) > 1)
      throw ImpossibleLateness(l.agent, fmt::format("'{}' is named twice; expected once", id));
  }
}

// Work begun before the plan continues at once, says every plan of the instance; of a late robot it
// does not.
void delay_work_begun_before(const Instance& instance, std::span<const Late> late, Plan& plan) {
  for (const Late& l : late) {
    if (!instance.world().is_working(instance.agent(l.agent).start)) continue;
    AgentPlan& robot = plan.agents[l.agent];
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

Plan late_plan(const Instance& instance, const Plan& plan, const ActionDependencyGraph& order,
               Time time, std::span<const Late> late) {
  require_possible(instance, time, late);
  const Wishes wishes(order, time, late);
  ExecutionTrace drive{std::vector<Time>(order.actions().size()),
                       std::vector<Time>(order.actions().size())};
  for (std::int32_t number = 0; number < order.step_count(); ++number) {
    Time begin = 0;
    for (const ActionIndex a : order.step(number)) {
      begin = std::max(begin, wishes.begin(a));
      if (order.before(a) != kNoAction) begin = std::max(begin, drive.end[order.before(a)]);
      if (const ActionIndex other = order.after(a); other != kNoAction)
        begin = std::max(begin, instance.may_follow() ? drive.begin[other] : drive.end[other]);
    }
    for (const ActionIndex a : order.step(number)) {
      if (wishes.is_certain(a) && begin > wishes.begin(a)) refuse(instance, order, a, time);
      drive.begin[a] = begin;
      drive.end[a] = begin + order.actions()[a].steps;
    }
  }
  Plan driven = executed_plan(instance, plan, order, drive);
  delay_work_begun_before(instance, late, driven);
  return driven;
}

}  // namespace grove::detail
