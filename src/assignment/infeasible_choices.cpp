// SPDX-License-Identifier: MIT
// Two arguments, each of which proves that there is no plan. Conflicts between agents are ignored.
//
// *Tasks.* An agent that has no path to a task, or no path from there to a destination of its own,
// cannot visit the task. If fewer agents than the task needs are left, there is no plan.
//
// *Goals.* Agents end on distinct goals. If the bipartite graph of agents and goals has no matching
// that covers every agent with goals, there is no plan (Hall 1935). An edge leads only to a goal
// that the agent can reach from its start.
#include "assignment/infeasible_choices.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "assignment/goal_choice.h"
#include "assignment/route_costs.h"

namespace grove::detail {
namespace {

enum class Obstacle : std::uint8_t { kCanVisit, kNoPathToTask, kNoPathToRest };

Obstacle obstacle(const Instance& instance, const DistanceFields& distances, AgentIndex index,
                  TaskIndex task) {
  const Agent& agent = instance.agent(index);
  if (distances.to_task(task)[agent.start] >= kNever) return Obstacle::kNoPathToTask;
  const bool can_rest =
      !agent.has_destination() || min_distance_from(instance.world(), instance.task(task).cell,
                                                    agent.kind, distances.to_rest(index)) < kNever;
  return can_rest ? Obstacle::kCanVisit : Obstacle::kNoPathToRest;
}

constexpr std::size_t kMaxNames = 8;  // in a list of a message

// Joins names with commas. If there are too many, the number of the others is at the end.
std::string joined(const std::vector<std::string>& names) {
  const std::size_t shown = names.size() > kMaxNames ? kMaxNames - 1 : names.size();
  const std::string text = fmt::format("{}", fmt::join(std::span(names).first(shown), ", "));
  return shown == names.size() ? text : fmt::format("{} and {} others", text, names.size() - shown);
}

std::string names(const Instance& instance, const std::vector<AgentIndex>& agents) {
  std::vector<std::string> ids;
  for (const AgentIndex agent : agents) ids.push_back("'" + instance.agent(agent).id + "'");
  return joined(ids);
}

std::string_view plural(std::size_t count) {
  return count == 1 ? "" : "s";
}

// The agents of a task by their obstacle.
struct Visitors {
  std::vector<AgentIndex> able;
  std::vector<AgentIndex> without_path;
  std::vector<AgentIndex> without_rest;
};

Visitors visitors_of(const Instance& instance, const DistanceFields& distances, TaskIndex task) {
  Visitors found;
  for (const AgentIndex agent : instance.task(task).agents)
    switch (obstacle(instance, distances, agent, task)) {
      case Obstacle::kCanVisit:
        found.able.push_back(agent);
        break;
      case Obstacle::kNoPathToTask:
        found.without_path.push_back(agent);
        break;
      case Obstacle::kNoPathToRest:
        found.without_rest.push_back(agent);
        break;
    }
  return found;
}

// Returns the obstacle of agents that have no path to the task. On a grid only walls separate
// places.
std::string no_path_text(const Instance& instance, const Task& task,
                         const std::vector<AgentIndex>& agents) {
  const std::string place = instance.world().name(task.cell);
  if (!instance.is_on_grid())
    return fmt::format("no roads lead from the start{} of {} to {}", plural(agents.size()),
                       names(instance, agents), place);
  return fmt::format("walls separate {} from the start{} of {}", place, plural(agents.size()),
                     agents.size() > 1 && agents.size() == task.agents.size()
                         ? "all of them"
                         : names(instance, agents));
}

std::string obstacles_text(const Instance& instance, const Task& task, const Visitors& visitors) {
  std::vector<std::string> texts;
  if (!visitors.without_path.empty())
    texts.push_back(no_path_text(instance, task, visitors.without_path));
  if (!visitors.without_rest.empty())
    texts.push_back(fmt::format("no path leads from {} to a destination of {}",
                                instance.world().name(task.cell),
                                names(instance, visitors.without_rest)));
  return fmt::format("{}", fmt::join(texts, ", and "));
}

std::string need_text(const Instance& instance, const Task& task,
                      const std::vector<AgentIndex>& able) {
  const std::string agents = names(instance, task.agents);
  if (task.agents.size() == 1)
    return fmt::format("task '{}' needs agent {}, which cannot visit it", task.id, agents);
  return fmt::format("task '{}' needs {} of its agents {}, but {} can visit it", task.id, task.need,
                     agents, able.empty() ? "none of them" : "only " + names(instance, able));
}

std::optional<std::string> task_without_visitors(const Instance& instance,
                                                 const DistanceFields& distances) {
  for (TaskIndex i = 0; i < instance.task_count(); ++i) {
    const Task& task = instance.task(i);
    const Visitors found = visitors_of(instance, distances, i);
    if (std::ssize(found.able) < task.need)
      return fmt::format("{}: {}", need_text(instance, task, found.able),
                         obstacles_text(instance, task, found));
  }
  return std::nullopt;
}

// Matches agents to goals by augmenting paths.
class GoalMatching {
 public:
  // `may_end`: whether the agent can end on a goal of its own.
  GoalMatching(const Instance& instance, std::function<bool(AgentIndex, Place)> may_end)
      : instance_(instance),
        may_end_(std::move(may_end)),
        places_(all_destinations(instance)),
        owner_(places_.size(), kFree) {}

  // Agents, and the goals on which they may end, which are fewer. Without agents: there are none.
  struct Shortage {
    std::vector<AgentIndex> agents;
    std::vector<Place> goals;
  };
  Shortage shortage() {
    for (AgentIndex agent = 0; agent < instance_.agent_count(); ++agent) {
      if (!instance_.agent(agent).has_destination()) continue;
      seen_.assign(places_.size(), false);
      if (!match(agent)) return shortage_of(agent);
    }
    return {};
  }

 private:
  static constexpr AgentIndex kFree = -1;

  bool match(AgentIndex agent) {
    for (const Place place : instance_.agent(agent).destinations()) {
      const auto i =
          static_cast<std::size_t>(std::ranges::lower_bound(places_, place) - places_.begin());
      if (seen_[i] || !may_end_(agent, place)) continue;
      seen_[i] = true;
      if (owner_[i] != kFree && !match(owner_[i])) continue;
      owner_[i] = agent;
      return true;
    }
    return false;
  }

  // `agent` and the owners of the goals that match() has seen may end only on these goals.
  Shortage shortage_of(AgentIndex agent) const {
    Shortage found{{agent}, {}};
    for (std::size_t i = 0; i < places_.size(); ++i) {
      if (!seen_[i]) continue;
      found.agents.push_back(owner_[i]);
      found.goals.push_back(places_[i]);
    }
    std::ranges::sort(found.agents);
    return found;
  }

  const Instance& instance_;
  const std::function<bool(AgentIndex, Place)> may_end_;
  std::vector<Place> places_;
  std::vector<AgentIndex> owner_;  // by index in places_
  std::vector<bool> seen_;
};

std::string shortage_text(const Instance& instance, const GoalMatching::Shortage& shortage,
                          std::string_view verb) {
  const auto& [agents, goals] = shortage;
  std::vector<std::string> places;
  for (const Place goal : goals) places.push_back(instance.world().name(goal));
  const std::string who =
      fmt::format("agent{} {} {}", plural(agents.size()), names(instance, agents), verb);
  if (goals.empty()) return fmt::format("{} none of its goals", who);
  return fmt::format("{} only {} goal{} ({}), but each must end on one of its own", who,
                     goals.size(), plural(goals.size()), joined(places));
}

std::optional<std::string> too_few_goals(const Instance& instance,
                                         const DistanceFields& distances) {
  if (std::ranges::none_of(instance.agents(), &Agent::has_destination)) return std::nullopt;
  const auto all = GoalMatching(instance, [](AgentIndex, Place) { return true; }).shortage();
  if (!all.agents.empty()) return shortage_text(instance, all, "have");
  const RouteCosts costs(instance, distances);
  const auto can_reach = [&](AgentIndex agent, Place goal) {
    return costs.start_to_goal(agent, goal) < kNever;
  };
  const auto reachable = GoalMatching(instance, can_reach).shortage();
  if (reachable.agents.empty()) return std::nullopt;
  return shortage_text(instance, reachable, "can reach");
}

}  // namespace

bool can_visit(const Instance& instance, const DistanceFields& distances, AgentIndex agent,
               TaskIndex task) {
  return obstacle(instance, distances, agent, task) == Obstacle::kCanVisit;
}

std::optional<std::string> infeasible_choices(const Instance& instance,
                                              const DistanceFields& distances) {
  if (auto reason = task_without_visitors(instance, distances)) return reason;
  return too_few_goals(instance, distances);
}

}  // namespace grove::detail
