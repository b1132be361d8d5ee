// SPDX-License-Identifier: MIT
// A *route* is the sequence of the stops of one agent; its cost is the sum of its legs. Insertion
// at the cheapest position, first of the tasks that the agent must visit.
//
// *Goals.* Before the optional visits are inserted, and after each pass of the local search, the
// agents get the goals that minimise the sum of the legs to them from the ends of their routes (an
// assignment problem).
//
// *Regret.* The next visit to insert is one whose second cheapest agent costs most in relation to
// its cheapest: if that agent's route changes, this visit loses most. For a task that needs several
// agents, its visits are inserted one after the other.
//
// *Effort.* After an insertion only the costs for the agent of the changed route are recomputed:
// O(visits * tasks * stops of a route), and O(visits * tasks) to compare the regrets if few visits
// have the changed agent among their two cheapest.
#include "assignment/insertion.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "assignment/route_costs.h"
#include "sequencing/assignment.h"

namespace grove::detail {
namespace {

constexpr int kMaxPasses = 20;  // of the local search

// Cheapest position for a task in a route.
struct Insertion {
  Time cost = kNever;  // increase of the route's cost; kNever: no route visits the task there
  std::size_t position = 0;
};

// The routes of all agents.
class Routes {
 public:
  explicit Routes(const RouteCosts& costs)
      : costs_(costs),
        instance_(costs.instance()),
        stops_(instance_.agents().size()),
        goals_(instance_.agents().size()) {
    for (AgentIndex i = 0; i < instance_.agent_count(); ++i) goals_[i] = instance_.agent(i).goal;
  }

  const std::vector<TaskIndex>& stops(AgentIndex agent) const { return stops_[agent]; }
  std::optional<Place> goal(AgentIndex agent) const { return goals_[agent]; }
  bool visits(AgentIndex agent, TaskIndex task) const {
    return std::ranges::count(stops_[agent], task) > 0;
  }

  Insertion cheapest(AgentIndex agent, TaskIndex task) const {
    const std::vector<TaskIndex>& stops = stops_[agent];
    Insertion best;
    if (stops.size() >= kMaxTasksPerAgent || visits(agent, task)) return best;
    for (std::size_t at = first_position(agent, task); at <= stops.size(); ++at) {
      const Time before =
          at == 0 ? costs_.from_start(agent, task) : costs_.between(agent, stops[at - 1], task);
      const Time after = leg_from(agent, task, at);
      if (before >= kNever || after >= kNever) continue;
      const Time cost = before + after - leg(agent, at);
      if (cost < best.cost) best = {cost, at};
    }
    return best;
  }
  void insert(AgentIndex agent, TaskIndex task, std::size_t position) {
    stops_[agent].insert(stops_[agent].begin() + static_cast<std::ptrdiff_t>(position), task);
  }
  // Returns by how much the cost of the route falls.
  Time remove(AgentIndex agent, TaskIndex task) {
    std::vector<TaskIndex>& stops = stops_[agent];
    const auto found = std::ranges::find(stops, task);
    const auto at = static_cast<std::size_t>(found - stops.begin());
    const Time before = leg(agent, at) + leg(agent, at + 1);
    stops.erase(found);
    return before - leg(agent, at);
  }

  // Chooses goals for all agents with a choice. Returns false if there are too few goals.
  bool choose_goals() {
    std::vector<Place> places;
    for (const Agent& agent : instance_.agents()) {
      places.insert(places.end(), agent.goals.begin(), agent.goals.end());
      if (agent.goal) places.push_back(*agent.goal);
    }
    std::ranges::sort(places);
    places.erase(std::unique(places.begin(), places.end()), places.end());
    std::vector<AgentIndex> rows;
    std::vector<std::vector<std::int64_t>> cost;
    for (AgentIndex i = 0; i < instance_.agent_count(); ++i) {
      const Agent& agent = instance_.agent(i);
      if (!agent.has_destination()) continue;
      rows.push_back(i);
      cost.emplace_back(places.size(), kForbidden);
      for (std::size_t column = 0; column < places.size(); ++column) {
        const bool is_own =
            agent.goal == places[column] || std::ranges::count(agent.goals, places[column]) > 0;
        if (!is_own) continue;
        const Time last = leg_to_goal(i, places[column]);
        if (last < kNever || agent.goal) cost.back()[column] = std::min(last, kNever);
      }
    }
    const auto columns = min_cost_assignment(cost);
    if (!columns) return false;
    for (std::size_t row = 0; row < rows.size(); ++row) goals_[rows[row]] = places[(*columns)[row]];
    return true;
  }

 private:
  // An agent that starts at work completes its task first.
  std::size_t first_position(AgentIndex agent, TaskIndex task) const {
    const State start = instance_.agent(agent).start;
    if (!instance_.world().is_working(start) || stops_[agent].empty()) return 0;
    return instance_.world().work(start).task == task ? 0 : 1;
  }
  // The leg into position `at` of the route, i.e. from the stop before it.
  Time leg(AgentIndex agent, std::size_t at) const {
    const std::vector<TaskIndex>& stops = stops_[agent];
    if (at == stops.size()) return at == 0 ? start_to_rest(agent) : to_rest(agent, stops[at - 1]);
    return at == 0 ? costs_.from_start(agent, stops[0])
                   : costs_.between(agent, stops[at - 1], stops[at]);
  }
  // The leg from `task` to the stop at position `at`.
  Time leg_from(AgentIndex agent, TaskIndex task, std::size_t at) const {
    return at == stops_[agent].size() ? to_rest(agent, task)
                                      : costs_.between(agent, task, stops_[agent][at]);
  }
  Time leg_to_goal(AgentIndex agent, Place goal) const {
    const std::vector<TaskIndex>& stops = stops_[agent];
    return stops.empty() ? costs_.start_to_goal(agent, goal)
                         : costs_.to_goal(agent, stops.back(), goal);
  }
  Time start_to_rest(AgentIndex agent) const {
    return goals_[agent] ? costs_.start_to_goal(agent, *goals_[agent]) : 0;
  }
  Time to_rest(AgentIndex agent, TaskIndex from) const {
    return goals_[agent] ? costs_.to_goal(agent, from, *goals_[agent]) : 0;
  }

  const RouteCosts& costs_;
  const Instance& instance_;
  std::vector<std::vector<TaskIndex>> stops_;  // by AgentIndex
  std::vector<std::optional<Place>> goals_;
};

// Inserts visits in the order of regret.
class RegretInsertion {
 public:
  RegretInsertion(const Instance& instance, Routes& routes) : instance_(instance), routes_(routes) {
    for (TaskIndex i = 0; i < instance.task_count(); ++i)
      if (!instance.task(i).needs_all()) open_.push_back({i, instance.task(i).need, {}, {}});
  }

  // A visit that an agent has begun at the start is its own.
  void count_visit(TaskIndex task) {
    for (Open& open : open_)
      if (open.task == task) --open.visits;
  }

  bool run(const Limits& limits) {
    std::erase_if(open_, [](const Open& open) { return open.visits <= 0; });
    for (Open& open : open_) find_agents(open);
    while (!open_.empty()) {
      if (limits.stop_requested()) return false;
      const auto next = std::ranges::max_element(open_, {}, &Open::regret);
      if (next->agents.empty()) return false;
      const AgentIndex agent = next->agents.front();
      routes_.insert(agent, next->task, routes_.cheapest(agent, next->task).position);
      if (--next->visits == 0)
        open_.erase(next);
      else
        find_agents(*next);
      for (Open& open : open_) update(open, agent);
    }
    return true;
  }

 private:
  // A task that needs more visits, and all agents that can insert it, the cheapest first.
  struct Open {
    TaskIndex task;
    int visits;
    std::vector<AgentIndex> agents;
    std::vector<Time> costs;

    Time regret() const {
      if (static_cast<int>(agents.size()) <= visits) return kNever;  // it needs all of them
      return costs[static_cast<std::size_t>(visits)] - costs[0];
    }
  };

  void find_agents(Open& open) {
    open.agents.clear();
    open.costs.clear();
    for (const AgentIndex agent : instance_.task(open.task).agents) add(open, agent);
  }
  void update(Open& open, AgentIndex changed) {
    const auto found = std::ranges::find(open.agents, changed);
    if (found == open.agents.end()) return;
    open.costs.erase(open.costs.begin() + (found - open.agents.begin()));
    open.agents.erase(found);
    add(open, changed);
  }
  void add(Open& open, AgentIndex agent) {
    const Time cost = routes_.cheapest(agent, open.task).cost;
    if (cost >= kNever) return;
    const auto at = std::ranges::upper_bound(open.costs, cost) - open.costs.begin();
    open.costs.insert(open.costs.begin() + at, cost);
    open.agents.insert(open.agents.begin() + at, agent);
  }

  const Instance& instance_;
  Routes& routes_;
  std::vector<Open> open_;
};

class Builder {
 public:
  Builder(const Instance& instance, const RouteCosts& costs)
      : instance_(instance), routes_(costs), insertion_(instance, routes_) {}

  std::optional<Assignment> run(const Limits& limits) {
    insert_begun();
    if (!insert_required() || !routes_.choose_goals() || !insertion_.run(limits))
      return std::nullopt;
    for (int pass = 0; pass < kMaxPasses && !limits.stop_requested(); ++pass)
      if (!move_visits() || !routes_.choose_goals()) break;
    return assignment();
  }

 private:
  void insert_begun() {
    for (AgentIndex i = 0; i < instance_.agent_count(); ++i) {
      const State start = instance_.agent(i).start;
      if (!instance_.world().is_working(start)) continue;
      const TaskIndex task = instance_.world().work(start).task;
      if (!instance_.task(task).needs_all()) insertion_.count_visit(task);
      routes_.insert(i, task, 0);
    }
  }
  bool insert_required() {
    for (AgentIndex i = 0; i < instance_.agent_count(); ++i)
      for (const TaskIndex task : instance_.agent(i).tasks) {
        if (routes_.visits(i, task)) continue;
        const Insertion best = routes_.cheapest(i, task);
        if (best.cost >= kNever) return false;
        routes_.insert(i, task, best.position);
      }
    return true;
  }

  // Moves each optional visit to its cheapest agent. Returns true if this made the routes cheaper.
  bool move_visits() {
    bool is_better = false;
    for (TaskIndex task = 0; task < instance_.task_count(); ++task) {
      if (instance_.task(task).needs_all()) continue;
      for (const AgentIndex agent : instance_.task(task).agents)
        if (routes_.visits(agent, task) && !is_begun(agent, task))
          is_better |= move_visit(agent, task);
    }
    return is_better;
  }
  bool move_visit(AgentIndex from, TaskIndex task) {
    const Time gain = routes_.remove(from, task);
    AgentIndex best_agent = -1;
    Insertion best;
    for (const AgentIndex agent : instance_.task(task).agents) {
      const Insertion here = routes_.cheapest(agent, task);
      if (here.cost < best.cost) {
        best = here;
        best_agent = agent;
      }
    }
    routes_.insert(best_agent, task, best.position);
    return best.cost < gain;
  }
  bool is_begun(AgentIndex agent, TaskIndex task) const {
    const State start = instance_.agent(agent).start;
    return instance_.world().is_working(start) && instance_.world().work(start).task == task;
  }

  Assignment assignment() const {
    Assignment assignment(instance_.agents().size());
    for (AgentIndex i = 0; i < instance_.agent_count(); ++i) {
      for (const TaskIndex task : routes_.stops(i))
        if (!instance_.task(task).needs_all()) assignment[i].visits.push_back(task);
      std::ranges::sort(assignment[i].visits);
      if (!instance_.agent(i).goals.empty()) assignment[i].goal = routes_.goal(i);
    }
    return assignment;
  }

  const Instance& instance_;
  Routes routes_;
  RegretInsertion insertion_;
};

}  // namespace

std::optional<Assignment> assignment_by_insertion(const Instance& instance,
                                                  const DistanceFields& distances,
                                                  const Limits& limits) {
  const RouteCosts costs(instance, distances);
  return Builder(instance, costs).run(limits);
}

}  // namespace grove::detail
