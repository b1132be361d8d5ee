// SPDX-License-Identifier: MIT
#include "assignment/routes.h"

#include <algorithm>
#include <cstdint>

#include "model/random.h"
#include "sequencing/assignment.h"

namespace grove::detail {

Routes::Routes(const RouteCosts& costs)
    : costs_(&costs),
      instance_(&costs.instance()),
      stops_(instance_->agents().size()),
      goals_(instance_->agents().size()) {
  for (AgentIndex i = 0; i < instance_->agent_count(); ++i) goals_[i] = instance_->agent(i).goal;
}

bool Routes::visits(AgentIndex agent, TaskIndex task) const {
  return std::ranges::count(stops_[agent], task) > 0;
}

Cost Routes::cost() const {
  Cost sum = 0;
  for (AgentIndex agent = 0; agent < instance_->agent_count(); ++agent)
    for (std::size_t at = 0; at <= stops_[agent].size(); ++at) sum += leg(agent, at);
  return sum;
}

Insertion Routes::cheapest(AgentIndex agent, TaskIndex task) const {
  const std::vector<TaskIndex>& stops = stops_[agent];
  Insertion best;
  if (stops.size() >= kMaxTasksPerAgent || visits(agent, task)) return best;
  for (std::size_t at = first_position(agent, task); at <= stops.size(); ++at) {
    const Time before =
        at == 0 ? costs_->from_start(agent, task) : costs_->between(agent, stops[at - 1], task);
    const Time after = leg_from(agent, task, at);
    if (before >= kNever || after >= kNever) continue;
    const Time cost = before + after - leg(agent, at);
    if (cost < best.cost) best = {cost, at};
  }
  return best;
}

void Routes::insert(AgentIndex agent, TaskIndex task, std::size_t position) {
  stops_[agent].insert(stops_[agent].begin() + static_cast<std::ptrdiff_t>(position), task);
}

Cost Routes::remove(AgentIndex agent, TaskIndex task) {
  std::vector<TaskIndex>& stops = stops_[agent];
  const auto found = std::ranges::find(stops, task);
  const auto at = static_cast<std::size_t>(found - stops.begin());
  const Cost before = Cost{leg(agent, at)} + leg(agent, at + 1);
  stops.erase(found);
  return before - leg(agent, at);
}

bool Routes::choose_goals(Time noise, std::uint64_t seed) {
  Random random(seed);
  std::vector<Place> places;
  for (const Agent& agent : instance_->agents()) {
    places.insert(places.end(), agent.goals.begin(), agent.goals.end());
    if (agent.goal) places.push_back(*agent.goal);
  }
  std::ranges::sort(places);
  places.erase(std::unique(places.begin(), places.end()), places.end());
  std::vector<AgentIndex> rows;
  std::vector<std::vector<std::int64_t>> cost;
  for (AgentIndex i = 0; i < instance_->agent_count(); ++i) {
    const Agent& agent = instance_->agent(i);
    if (!agent.has_destination()) continue;
    rows.push_back(i);
    cost.emplace_back(places.size(), kForbidden);
    const auto allow = [&](Place goal, Time leg) {
      const auto column = std::ranges::lower_bound(places, goal) - places.begin();
      cost.back()[static_cast<std::size_t>(column)] = leg + random.below(noise + 1);
    };
    if (agent.goal) allow(*agent.goal, 0);
    for (const Place goal : agent.goals)
      if (const Time leg = leg_to_goal(i, goal); leg < kNever) allow(goal, leg);
  }
  const auto columns = min_cost_assignment(cost);
  if (!columns) return false;
  for (std::size_t row = 0; row < rows.size(); ++row)
    goals_[rows[row]] = places[static_cast<std::size_t>((*columns)[row])];
  return true;
}

// An agent that starts at work completes its task first.
std::size_t Routes::first_position(AgentIndex agent, TaskIndex task) const {
  const State start = instance_->agent(agent).start;
  if (!instance_->world().is_working(start) || stops_[agent].empty()) return 0;
  return instance_->world().work(start).task == task ? 0 : 1;
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
  return goals_[agent] ? costs_->to_goal(agent, from, *goals_[agent]) : 0;
}

}  // namespace grove::detail
