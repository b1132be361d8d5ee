// SPDX-License-Identifier: MIT
// A *route* is the sequence of the stops of one agent; its cost is the sum of its legs. Insertion
// at the cheapest position, first of the tasks that the agent must visit.
//
// *Goals.* Before the optional visits are inserted, and after each pass of large neighbourhood
// search, the agents get the goals that minimise the sum of the legs to them from the ends of their
// routes (an assignment problem).
//
// *Regret.* The next visit to insert is that of a task for which the cheapest agent saves most over
// the agent after those that the task still needs (with one visit left: the second cheapest). For a
// task that needs several agents, the visits are inserted one after the other.
//
// *Variants.* From the best routes, large neighbourhood search that accepts all routes below the
// limit, and then goals that minimise the sum of legs to which a few random steps are added.
//
// *Effort.* After an insertion only the costs for the agent of the changed route are recomputed:
// O(visits * tasks * (stops of a route + agents)) in total.
#include "assignment/assignment_search.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "assignment/assignment_lns.h"
#include "assignment/route_costs.h"
#include "assignment/routes.h"
#include "model/random.h"

namespace grove::detail {
namespace {

constexpr int kPasses = 3;  // of large neighbourhood search and choice of goals
// Insertions into a route that are tried per pass: per task and agent, and at most (about 0.1 s).
constexpr std::int64_t kInsertionsEach = 2000;
constexpr int kAttempts = 10;  // to find another assignment
constexpr Time kMaxNoise = 4;  // steps
constexpr std::int64_t kMaxInsertions = 2'000'000;

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

}  // namespace

class AssignmentSearch::Builder {
 public:
  Builder(const Instance& instance, const DistanceFields& distances, std::uint64_t seed,
          Cost visit_weight)
      : instance_(instance),
        costs_(instance, distances),
        routes_(costs_, visit_weight),
        seed_(seed) {}

  std::optional<Assignment> first(const Limits& limits) {
    RegretInsertion insertion(instance_, routes_);
    insert_begun(insertion);
    if (!insert_required() || !routes_.choose_goals() || !insertion.run(limits))
      return std::nullopt;
    for (int pass = 0; pass < kPasses && !limits.stop_requested(); ++pass) {
      improve_routes(routes_, insertions(), seed_++, limits);
      routes_.choose_goals();
    }
    return remembered(assignment(routes_));
  }

  std::optional<Assignment> first_from(const Plan& plan, const Limits& limits) {
    RegretInsertion insertion(instance_, routes_);
    insert_begun(insertion);
    insert_visits(plan, insertion);
    if (!set_goals(plan) && !routes_.choose_goals()) return std::nullopt;
    if (!insert_required() || !insertion.run(limits)) return std::nullopt;
    separate_ends();
    return remembered(assignment(routes_));
  }

  Assignment improved(std::int64_t insertions, const Limits& limits) {
    improve_routes(routes_, insertions, seed_++, limits);
    Routes other = routes_;
    if (other.choose_goals() && other.cost() < routes_.cost()) routes_ = std::move(other);
    separate_ends();
    return remembered(assignment(routes_));
  }

  std::optional<Assignment> next(Cost cost_limit, const Limits& limits) {
    cost_limit = std::min(cost_limit, routes_.cost() + routes_.cost() / 10 + kMaxNoise);
    for (int attempt = 0; attempt < kAttempts && !limits.stop_requested(); ++attempt) {
      Routes routes = routes_;
      if (routes.cost() >= cost_limit)
        improve_routes(routes, insertions(), seed_++, limits);
      else
        vary_routes(routes, limit_of_variant(cost_limit), insertions() / kAttempts, seed_++,
                    limits);
      const Time noise = static_cast<Time>(seed_ % (kMaxNoise + 1));
      if (!routes.choose_goals(noise, seed_) || routes.cost() >= cost_limit) continue;
      Assignment found = assignment(routes);
      if (known_.contains(found)) continue;
      if (routes.cost() < routes_.cost()) routes_ = routes;
      return remembered(std::move(found));
    }
    return std::nullopt;
  }
  const Routes& routes() const { return routes_; }

 private:
  // Between the cost of the best routes and `cost_limit`; low limits are more likely, because
  // conflicts add to the cost.
  Cost limit_of_variant(Cost cost_limit) {
    const Cost range = std::max<Cost>(1, cost_limit - routes_.cost());
    const Cost part = random_.below(static_cast<std::uint64_t>(range));
    return routes_.cost() + 1 + part * part / range;
  }

  Assignment remembered(Assignment found) {
    known_.insert(found);
    return found;
  }

  void insert_begun(RegretInsertion& insertion) {
    for (AgentIndex i = 0; i < instance_.agent_count(); ++i) {
      const auto task = task_at_start(instance_, i);
      if (!task) continue;
      if (!instance_.task(*task).needs_all()) insertion.count_visit(*task);
      routes_.insert(i, *task, 0);
    }
  }
  // Appends the visits of the plan to the routes, except surplus visits.
  void insert_visits(const Plan& plan, RegretInsertion& insertion) {
    std::vector<int> missing;
    for (const Task& task : instance_.tasks()) missing.push_back(task.need);
    for (AgentIndex i = 0; i < instance_.agent_count(); ++i)
      if (const auto task = task_at_start(instance_, i)) --missing[*task];
    for (AgentIndex i = 0; i < instance_.agent_count(); ++i)
      for (const TaskIndex task : plan.agents[i].sequence) {
        const bool is_full = routes_.stops(i).size() >= kMaxTasksPerAgent;
        if (is_full || routes_.visits(i, task) || missing[task] <= 0) continue;
        routes_.insert(i, task, routes_.stops(i).size());
        --missing[task];
        if (!instance_.task(task).needs_all()) insertion.count_visit(task);
      }
  }
  // Sets the goals on which the agents end in the plan. Returns false if an agent ends elsewhere,
  // or where another agent has its destination.
  bool set_goals(const Plan& plan) {
    std::set<Place> taken;
    for (const Agent& agent : instance_.agents())
      if (agent.goal) taken.insert(*agent.goal);
    for (AgentIndex i = 0; i < instance_.agent_count(); ++i) {
      const std::vector<Place>& goals = instance_.agent(i).goals;
      const Place rest = instance_.world().place(plan.agents[i].path.back());
      if (goals.empty()) continue;
      if (std::ranges::count(goals, rest) == 0 || !taken.insert(rest).second) return false;
    }
    for (AgentIndex i = 0; i < instance_.agent_count(); ++i)
      if (!instance_.agent(i).goals.empty())
        routes_.set_goal(i, instance_.world().place(plan.agents[i].path.back()));
    return true;
  }
  // If the routes of two agents without a destination end on one place, moves the last visit of one
  // to the end of the other, if it may. With one stop each, such routes would have no plan.
  void separate_ends() {
    std::map<Place, AgentIndex> enders;
    for (AgentIndex i = 0; i < instance_.agent_count(); ++i) {
      if (instance_.agent(i).has_destination() || routes_.stops(i).empty()) continue;
      const TaskIndex last = routes_.stops(i).back();
      const auto [other, is_new] = enders.try_emplace(instance_.task(last).cell, i);
      const bool is_begun = task_at_start(instance_, i) == last;
      const Task& task = instance_.task(last);
      if (is_new || is_begun || task.needs_all() || routes_.visits(other->second, last) ||
          std::ranges::count(task.agents, other->second) == 0 ||
          routes_.stops(other->second).size() >= kMaxTasksPerAgent)
        continue;
      routes_.remove(i, last);
      routes_.insert(other->second, last, routes_.stops(other->second).size());
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

  Assignment assignment(const Routes& routes) const {
    Assignment assignment(instance_.agents().size());
    for (AgentIndex i = 0; i < instance_.agent_count(); ++i) {
      for (const TaskIndex task : routes.stops(i))
        if (!instance_.task(task).needs_all()) assignment[i].visits.push_back(task);
      std::ranges::sort(assignment[i].visits);
      if (!instance_.agent(i).goals.empty()) assignment[i].goal = routes.goal(i);
    }
    return assignment;
  }

  std::int64_t insertions() const {
    return std::min(kMaxInsertions,
                    kInsertionsEach * instance_.task_count() * instance_.agent_count());
  }

  const Instance& instance_;
  const RouteCosts costs_;
  Routes routes_;  // the best so far
  std::uint64_t seed_;
  Random random_{seed_};
  std::set<Assignment> known_;  // returned so far
};

AssignmentSearch::AssignmentSearch(const Instance& instance, const DistanceFields& distances,
                                   std::uint64_t seed, Cost visit_weight)
    : builder_(std::make_unique<Builder>(instance, distances, seed, visit_weight)) {}
AssignmentSearch::~AssignmentSearch() = default;

std::optional<Assignment> AssignmentSearch::first(const Limits& limits) {
  return builder_->first(limits);
}

std::optional<Assignment> AssignmentSearch::first_from(const Plan& plan, const Limits& limits) {
  return builder_->first_from(plan, limits);
}

Assignment AssignmentSearch::improved(std::int64_t insertions, const Limits& limits) {
  return builder_->improved(insertions, limits);
}

std::optional<Assignment> AssignmentSearch::next(Cost cost_limit, const Limits& limits) {
  return builder_->next(cost_limit, limits);
}

const Routes& AssignmentSearch::routes() const {
  return builder_->routes();
}

}  // namespace grove::detail
