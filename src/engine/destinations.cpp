// SPDX-License-Identifier: MIT
// Problem: choose the task on which each agent without a destination ends. The choice is a
// least-cost assignment of agents to places with tasks, because no two agents can rest on one
// place. The cost of (agent, place) is the cost of the agent's best sequence that ends on
// its task there, plus a charge for each other agent that must visit the place.
//
// Charge for visitors. Once an agent rests, no other agent can visit its place. All other agents
// that must visit the place have to do so before, which under fixed sequences is often possible
// only at a very high cost. Without a charge, plans that end on the chosen tasks cost hardly more
// than other plans, but the instance is hardly easier to solve. Measured on 36 instances (the
// paper's three maps, N = 5 and 10, M = 10 to 30; policy fixed, 4 s): CTS-CBS-A solves 17 or 18, B
// without a charge 23, B with 12 steps per visitor 32 (visitor_steps in model/tunables.def). (With
// an additional charge for destinations in corridors, B solved no more.)
//
// All ends in one table. CTS-CBS-B accepts only plain worlds (method.cpp), in which distances are
// symmetric. Therefore a sequence from the start that ends on e, read backwards, starts on e and
// ends at the start. Hence the cost-to-go table of a matrix whose destination is the start gives,
// for every stop e, the cost through all other stops. The table is exact for ends up to a limit
// above the cost of the best end. The limit is raised until no other end can improve the
// assignment: an end above the limit costs at least outside_bound(), and an assignment that uses it
// costs at least that plus the costs of the best ends of all other agents.
#include "engine/destinations.h"

#include <algorithm>
#include <map>
#include <set>

#include "sequencing/assignment.h"
#include "sequencing/cost_matrix.h"
#include "sequencing/cost_to_go.h"
#include "sequencing/rtsp.h"
#include "sequencing/sum_of_best_sequences.h"

namespace grove::detail {
namespace {

constexpr Time kFirstReach = 8;  // first limit above the cost of the best end, in steps

// Sequence costs of one agent without a destination, by the task on which it ends.
class Ends {
 public:
  Ends(const Problem& problem, AgentIndex agent)
      : agent_(agent), tasks_(problem.instance.agent(agent).tasks), ends_(backwards(problem)) {}

  AgentIndex agent() const { return agent_; }
  const std::vector<TaskIndex>& tasks() const { return tasks_; }

  // Computes the costs of all ends that cost at most `reach` more than the best end. Returns false
  // if a limit was reached, or if no sequence visits all tasks of the agent.
  bool extend(Time reach, const Limits& limits) {
    if (best_ == kNever && !find_best(limits)) return false;
    return all_known() || ends_.extend(std::min(best_ + reach, kNever - 1), limits);
  }
  Time best() const { return best_; }
  // Least cost of a sequence that ends on `stop`; kNever: not known, but at least outside_bound().
  Time cost(int stop) const {
    return ends_.cost_to_go(ends_.matrix().all() & ~(StopSet{1} << stop), stop);
  }
  Time outside_bound() const { return ends_.outside_bound(); }
  bool all_known() const { return ends_.outside_bound() >= kNever; }

 private:
  CostMatrix backwards(const Problem& problem) const {
    CostMatrix matrix = cost_matrix(problem.instance, agent_, problem.distances);
    const int n = matrix.stops();
    for (int stop = 0; stop < n; ++stop) matrix.cost(stop, n) = matrix.cost(n, stop);
    for (int to = 0; to <= n; ++to) matrix.cost(n, to) = 0;
    return matrix;
  }

  bool find_best(const Limits& limits) {
    for (Time reach = relaxation_bound(ends_.matrix()); best_ == kNever; ++reach) {
      reach = std::max(reach, std::min(ends_.outside_bound(), kNever - 1));
      if (!ends_.extend(reach, limits)) return false;
      for (int stop = 0; stop < ends_.matrix().stops(); ++stop) best_ = std::min(best_, cost(stop));
      if (best_ > ends_.outside_bound()) best_ = kNever;  // an unknown end can be better
      if (best_ == kNever && all_known()) return false;
    }
    return true;
  }

  AgentIndex agent_;
  std::vector<TaskIndex> tasks_;
  CostToGo ends_;
  Time best_ = kNever;
};

class DestinationChooser {
 public:
  DestinationChooser(const Problem& problem, Cost visitor_steps, const Limits& limits)
      : problem_(problem), visitor_steps_(visitor_steps), limits_(limits) {
    const Instance& instance = problem.instance;
    for (AgentIndex agent = 0; agent < instance.agent_count(); ++agent)
      if (!instance.agent(agent).goal) ends_.emplace_back(problem, agent);
    std::map<Place, TaskIndex> first_tasks;
    std::map<TaskIndex, std::set<AgentIndex>> agents;
    for (TaskIndex task = 0; task < instance.task_count(); ++task) {
      const Task& t = instance.task(task);
      columns_.push_back(first_tasks.try_emplace(t.cell, task).first->second);
      agents[columns_.back()].insert(t.agents.begin(), t.agents.end());
    }
    for (const TaskIndex column : columns_) visitors_.push_back(std::ssize(agents[column]) - 1);
  }

  std::optional<Destinations> choose() {
    Destinations chosen;
    if (!add_bound_of_others(chosen.bound)) return std::nullopt;
    for (Time reach = kFirstReach;; reach *= 2) {
      for (Ends& ends : ends_)
        if (!ends.extend(reach, limits_)) return std::nullopt;
      const auto assignment = min_cost_assignment(costs());
      if (is_best(assignment))
        return assignment ? finish(chosen, assignment->columns) : std::nullopt;
    }
  }

 private:
  // Adds the best sequence costs of the agents that have a destination to `bound`. Returns false if
  // a cost is not known exactly.
  bool add_bound_of_others(Cost& bound) const {
    const Instance& instance = problem_.instance;
    for (AgentIndex agent = 0; agent < instance.agent_count(); ++agent) {
      if (!instance.agent(agent).goal) continue;
      const RtspAnswer answer = best_sequence_cost(instance, agent, problem_.distances, limits_);
      if (answer.kind != RtspAnswer::Kind::kExact) return false;
      bound += answer.cost;
    }
    return true;
  }

  // Cost matrix of the assignment, by position in ends_, then by column.
  std::vector<std::vector<std::int64_t>> costs() const {
    const auto tasks = static_cast<std::size_t>(problem_.instance.task_count());
    std::vector<std::vector<std::int64_t>> costs(ends_.size(),
                                                 std::vector<std::int64_t>(tasks, kForbidden));
    for (std::size_t i = 0; i < ends_.size(); ++i)
      for (TaskIndex task : ends_[i].tasks())
        if (const Cost cost = cost_of(ends_[i], task); cost < kNever && !is_destination(task))
          costs[i][columns_[task]] = cost;
    return costs;
  }
  // Cost of an end including the charge for visitors; kNever or more: not known.
  Cost cost_of(const Ends& ends, TaskIndex task) const {
    const auto stop = std::ranges::find(ends.tasks(), task) - ends.tasks().begin();
    return ends.cost(static_cast<int>(stop)) + visitor_steps_ * visitors_[task];
  }
  // The agent's task in this column. The agent must have one; it never has two (method.cpp).
  TaskIndex task_in(const Ends& ends, int column) const {
    return *std::ranges::find(ends.tasks(), column, [&](TaskIndex task) { return columns_[task]; });
  }
  bool is_destination(TaskIndex task) const {
    return std::ranges::any_of(problem_.instance.agents(), [&](const Agent& agent) {
      return agent.goal == problem_.instance.task(task).cell;
    });
  }

  // True if no assignment that uses an end of unknown cost can be better than `assignment`.
  bool is_best(const std::optional<MinCostAssignment>& assignment) const {
    if (std::ranges::all_of(ends_, &Ends::all_known)) return true;
    if (!assignment) return false;
    Cost excess = 0;
    for (std::size_t i = 0; i < ends_.size(); ++i)
      excess += cost_of(ends_[i], task_in(ends_[i], assignment->columns[i])) - ends_[i].best();
    return std::ranges::all_of(ends_, [&](const Ends& ends) {
      return ends.all_known() || excess < ends.outside_bound() - ends.best();
    });
  }
  std::optional<Destinations> finish(Destinations chosen,
                                     const std::vector<int>& assignment) const {
    chosen.tasks.assign(static_cast<std::size_t>(problem_.instance.agent_count()), kNoTask);
    for (std::size_t i = 0; i < ends_.size(); ++i) {
      chosen.tasks[ends_[i].agent()] = task_in(ends_[i], assignment[i]);
      chosen.bound += ends_[i].best();
    }
    return chosen;
  }

  const Problem& problem_;
  const Cost visitor_steps_;
  const Limits& limits_;
  std::vector<Ends> ends_;
  std::vector<TaskIndex> columns_;  // by task: the first task on its place
  std::vector<Cost> visitors_;      // by task: number of agents with a task on its place, less 1
};

}  // namespace

std::optional<Destinations> choose_destinations(const Problem& problem, Cost visitor_steps,
                                                const Limits& limits) {
  return DestinationChooser(problem, visitor_steps, limits).choose();
}

Instance with_destinations(const Instance& instance, const Destinations& destinations) {
  InstanceBuilder builder = InstanceBuilder::like(instance);
  for (AgentIndex i = 0; i < instance.agent_count(); ++i) {
    const Agent& agent = instance.agent(i);
    const TaskIndex end = destinations.tasks[i];
    const auto goal = end == kNoTask ? agent.goal : std::optional(instance.task(end).cell);
    builder.add_agent(agent.id, agent.start, goal);
  }
  for (TaskIndex t = 0; t < instance.task_count(); ++t) {
    std::vector<std::string> ids;
    for (AgentIndex agent : instance.task(t).agents)
      if (destinations.tasks[agent] != t) ids.push_back(instance.agent(agent).id);
    if (!ids.empty()) builder.add_task(instance.task(t).id, instance.task(t).cell, ids);
  }
  return std::move(builder).build();
}

Plan without_destinations(const Instance& instance, const Destinations& destinations, Plan plan) {
  std::vector<TaskIndex> kept;  // by TaskIndex of with_destinations()
  for (TaskIndex t = 0; t < instance.task_count(); ++t)
    if (std::ranges::any_of(instance.task(t).agents,
                            [&](AgentIndex agent) { return destinations.tasks[agent] != t; }))
      kept.push_back(t);
  for (AgentIndex i = 0; i < instance.agent_count(); ++i) {
    for (TaskIndex& task : plan.agents[i].sequence) task = kept[task];
    if (destinations.tasks[i] != kNoTask) plan.agents[i].sequence.push_back(destinations.tasks[i]);
  }
  return plan;
}

}  // namespace grove::detail
