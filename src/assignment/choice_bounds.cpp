// SPDX-License-Identifier: MIT
// Proof of the lower bound. Conflicts between agents are ignored.
//
// *Base.* Let b(a, g) be a lower bound on the cost of a path of agent a that visits the tasks that
// a must visit and ends on g. The agents end on different goals, so the sum of the base costs is at
// least the least cost of an assignment of goals to agents. If there is no assignment of finite
// cost, there is no plan. Agents without a destination add the least cost of their required tasks.
//
// *Detours.* Let an agent that turns freely visit an optional task t between its stops i and j (a
// stop is the start, a task or the goal). Without t it could go from i to j directly, so its cost
// would fall by at least d(i, t) + d(t, j) - d(i, j), or by d(i, t) if t is its last stop. Let the
// detour of (a, t) be the minimum of this over all i and j that the agent may have as stops, but at
// least 0. *Claim: a path that visits the optional tasks T costs at least b(a, g) plus the detours
// of T.* *Proof.* Remove the tasks one after the other. Each removal lowers the least cost of a
// path through the remaining stops by at least the detour. (The order of the other stops stays the
// same. The distances are exact: on the place of a task such an agent has only one base state, and
// a leg to a task includes its execution.) In the end only the required tasks are left. An agent
// without a destination that must visit a task still rests on a task that it visits: if the last
// stop is removed, the stop before is a task. For agents whose turns take time, and for agents that
// start at work, the detours are taken as 0: leaving out a visit never makes a
// path invalid, unless the agent rests there, and then it can end on its stop before.
//
// *Sum.* Each task is visited by at least `need` different agents, so its detours add up to at
// least the sum of the `need` least ones.
#include "assignment/choice_bounds.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "assignment/goal_choice.h"
#include "assignment/infeasible_choices.h"
#include "assignment/route_costs.h"
#include "sequencing/sum_of_best_sequences.h"

namespace grove::detail {
namespace {

class Bound {
 public:
  Bound(const Instance& instance, const DistanceFields& distances, const Limits& limits)
      : instance_(instance),
        distances_(distances),
        limits_(limits),
        costs_(instance, distances),
        goals_(all_destinations(instance, [](const Agent& agent) { return agent.kind == 0; })),
        between_stops_(instance.tasks().size(), kUnknown) {}

  Cost total() {
    Cost sum = base();
    if (sum >= kInfiniteCost) return kInfiniteCost;
    for (TaskIndex task = 0; task < instance_.task_count(); ++task)
      if (!instance_.task(task).needs_all() && !limits_.stop_requested())
        sum += sum_of_detours(task);
    return sum;
  }

 private:
  Cost base() const {
    std::vector<Cost> least(instance_.agents().size());
    Cost sum = 0;
    for (AgentIndex agent = 0; agent < instance_.agent_count(); ++agent) {
      least[agent] = least_cost(agent);
      if (!instance_.agent(agent).has_destination()) sum += least[agent];
    }
    const auto choice = cheapest_goals(instance_, [&](AgentIndex agent, Place goal) {
      const Cost cost = std::max(least[agent], cost_to_end_on(agent, goal));
      return cost < kNever ? std::optional(cost) : std::nullopt;
    });
    return choice ? sum + choice->cost : kInfiniteCost;
  }

  // A lower bound on the cost of the required tasks, wherever the agent ends.
  Cost least_cost(AgentIndex agent) const {
    if (instance_.agent(agent).is_idle()) return 0;
    const RtspAnswer answer = best_sequence_cost(instance_, agent, distances_, limits_);
    return answer.kind == RtspAnswer::Kind::kInfeasible ? 0 : answer.cost;
  }
  // A lower bound on the cost of the required tasks if the agent ends on `goal`.
  Cost cost_to_end_on(AgentIndex index, Place goal) const {
    Cost cost = costs_.start_to_goal(index, goal);
    for (const TaskIndex task : instance_.agent(index).tasks)
      cost =
          std::max(cost, Cost{costs_.from_start(index, task)} + costs_.to_goal(index, task, goal));
    return cost;
  }

  // The sum of the least detours of as many agents as the task needs.
  Cost sum_of_detours(TaskIndex task) {
    std::vector<Cost> detours;
    for (const AgentIndex agent : instance_.task(task).agents)
      if (can_visit(instance_, distances_, agent, task)) detours.push_back(detour(agent, task));
    std::ranges::sort(detours);
    const auto need = std::min(static_cast<std::size_t>(instance_.task(task).need), detours.size());
    return std::accumulate(detours.begin(), detours.begin() + static_cast<std::ptrdiff_t>(need),
                           Cost{0});
  }
  Cost detour(AgentIndex index, TaskIndex task) {
    const Agent& agent = instance_.agent(index);
    if (agent.kind > 0 || instance_.world().is_working(agent.start)) return 0;
    const Cost first = costs_.from_start(index, task);
    Cost least = detour_between_stops(index, task);
    if (!agent.has_destination()) least = std::min({least, first, least_leg_to(index, task)});
    for (TaskIndex next = 0; next < instance_.task_count() && least > 0; ++next)
      if (next != task)
        least = std::min(
            least, first + costs_.between(index, task, next) - costs_.from_start(index, next));
    for (const Place goal : agent.destinations())
      least = std::min(
          least, first + costs_.to_goal(index, task, goal) - costs_.start_to_goal(index, goal));
    return std::max(least, Cost{0});
  }

  // The least detour from any task to any task or goal, for agents that turn freely.
  Cost detour_between_stops(AgentIndex agent, TaskIndex task) {
    Cost& least = between_stops_[static_cast<std::size_t>(task)];
    if (least != kUnknown) return least;
    least = kNever;
    for (TaskIndex before = 0; before < instance_.task_count() && least > 0; ++before) {
      if (before == task) continue;
      const Cost leg = costs_.between(agent, before, task);
      for (TaskIndex next = 0; next < instance_.task_count(); ++next)
        if (next != task && next != before)
          least = std::min(
              least, leg + costs_.between(agent, task, next) - costs_.between(agent, before, next));
      for (const Place goal : goals_)
        least = std::min(
            least, leg + costs_.to_goal(agent, task, goal) - costs_.to_goal(agent, before, goal));
    }
    return least = std::max(least, Cost{0});
  }
  Cost least_leg_to(AgentIndex agent, TaskIndex task) const {
    Cost least = kNever;
    for (TaskIndex before = 0; before < instance_.task_count(); ++before)
      if (before != task) least = std::min(least, Cost{costs_.between(agent, before, task)});
    return least;
  }

  static constexpr Cost kUnknown = -1;

  const Instance& instance_;
  const DistanceFields& distances_;
  const Limits& limits_;
  const RouteCosts costs_;
  std::vector<Place> goals_;         // of agents that turn freely
  std::vector<Cost> between_stops_;  // by task: detour_between_stops()
};

}  // namespace

Cost lower_bound_of_choices(const Instance& instance, const DistanceFields& distances,
                            const Limits& limits) {
  return Bound(instance, distances, limits).total();
}

}  // namespace grove::detail
