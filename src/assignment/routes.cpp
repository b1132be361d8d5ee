// SPDX-License-Identifier: MIT
#include "assignment/routes.h"

#include <algorithm>
#include <cstdint>

#include "assignment/goal_choice.h"
#include "model/random.h"

namespace grove::detail {

std::optional<TaskIndex> task_at_start(const Instance& instance, AgentIndex agent) {
  const State start = instance.agent(agent).start;
  if (!instance.world().is_working(start)) return std::nullopt;
  return instance.world().work(start).task;
}

Routes::Routes(const RouteCosts& costs, Cost visit_weight)
    : costs_(&costs),
      instance_(&costs.instance()),
      visit_weight_(visit_weight),
      stops_(instance_->agents().size()),
      goals_(instance_->agents().size()),
      legs_to_rest_(instance_->agents().size()) {
  for (AgentIndex i = 0; i < instance_->agent_count(); ++i) {
    goals_[i] = instance_->agent(i).goal;
    starts_at_work_.push_back(task_at_start(*instance_, i).has_value());
  }
  find_legs_to_rest();
}

void Routes::find_legs_to_rest() {
  for (AgentIndex i = 0; i < instance_->agent_count(); ++i)
    legs_to_rest_[i] = goals_[i] ? &costs_->legs_to_goal(i, *goals_[i]) : nullptr;
}

bool Routes::visits(AgentIndex agent, TaskIndex task) const {
  return std::ranges::count(stops_[agent], task) > 0;
}

Cost Routes::cost() const {
  Cost sum = 0;
  for (AgentIndex agent = 0; agent < instance_->agent_count(); ++agent) sum += cost(agent);
  return sum;
}

Cost Routes::cost(AgentIndex agent) const {
  const std::size_t count = stops_[agent].size();
  Cost arrival = 0;
  Cost visits = 0;
  for (std::size_t at = 0; at < count; ++at) {
    arrival += leg(agent, at);
    visits += arrival;
  }
  return arrival + leg(agent, count) + visit_weight_ * visits;
}

Time Routes::insertion_cost(AgentIndex agent, std::size_t at, Cost arrival, Time before,
                            Time after) const {
  const Time detour = before + after - leg(agent, at);
  if (visit_weight_ == 0) return detour;
  const auto later = static_cast<Cost>(stops_[agent].size() - at);  // stops that are then delayed
  const Cost cost = detour + visit_weight_ * (arrival + before + later * detour);
  return static_cast<Time>(std::min<Cost>(cost, kNever - 1));
}

void Routes::insert(AgentIndex agent, TaskIndex task, std::size_t position) {
  stops_[agent].insert(stops_[agent].begin() + static_cast<std::ptrdiff_t>(position), task);
}

Cost Routes::remove(AgentIndex agent, TaskIndex task) {
  std::vector<TaskIndex>& stops = stops_[agent];
  const auto found = std::ranges::find(stops, task);
  const auto at = static_cast<std::size_t>(found - stops.begin());
  if (visit_weight_ > 0) {
    const Cost before = cost(agent);
    stops.erase(found);
    return before - cost(agent);
  }
  const Cost before = Cost{leg(agent, at)} + leg(agent, at + 1);
  stops.erase(found);
  return before - leg(agent, at);
}

void Routes::set_goal(AgentIndex agent, Place goal) {
  goals_[agent] = goal;
  legs_to_rest_[agent] = &costs_->legs_to_goal(agent, goal);
}

// The order of the draws is that of agents and of their goals, so it is repeatable.
bool Routes::choose_goals(Time noise, std::uint64_t seed) {
  Random random(seed);
  const auto cost = [&](AgentIndex agent, Place goal) -> std::optional<Cost> {
    const bool is_fixed = instance_->agent(agent).goal.has_value();
    const Time leg = is_fixed ? 0 : leg_to_goal(agent, goal);
    if (leg >= kNever) return std::nullopt;
    return Cost{leg} + random.below(noise + 1);
  };
  auto choice = cheapest_goals(*instance_, cost);
  if (!choice) return false;
  goals_ = std::move(choice->goals);
  find_legs_to_rest();
  return true;
}

// An agent that starts at work completes its task first.
std::size_t Routes::first_position(AgentIndex agent, TaskIndex task) const {
  if (!starts_at_work_[agent] || stops_[agent].empty()) return 0;
  return task_at_start(*instance_, agent) == task ? 0 : 1;
}

// The leg into position `at` of the route, i.e. from the stop before it.
Time Routes::leg(AgentIndex agent, std::size_t at) const {
  const std::vector<TaskIndex>& stops = stops_[agent];
  if (at == stops.size()) return at == 0 ? start_to_rest(agent) : to_rest(agent, stops[at - 1]);
  return at == 0 ? costs_->from_start(agent, stops[0])
                 : costs_->between(agent, stops[at - 1], stops[at]);
}

// The leg from `task` to the stop at position `at`.
Time Routes::leg_from(AgentIndex agent, TaskIndex task, std::size_t at) const {
  return at == stops_[agent].size() ? to_rest(agent, task)
                                    : costs_->between(agent, task, stops_[agent][at]);
}

Time Routes::leg_to_goal(AgentIndex agent, Place goal) const {
  const std::vector<TaskIndex>& stops = stops_[agent];
  return stops.empty() ? costs_->start_to_goal(agent, goal)
                       : costs_->to_goal(agent, stops.back(), goal);
}

Time Routes::start_to_rest(AgentIndex agent) const {
  return goals_[agent] ? costs_->start_to_goal(agent, *goals_[agent]) : 0;
}

Time Routes::to_rest(AgentIndex agent, TaskIndex from) const {
  return legs_to_rest_[agent] ? (*legs_to_rest_[agent])[from] : 0;
}

}  // namespace grove::detail
