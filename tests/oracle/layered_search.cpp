// SPDX-License-Identifier: MIT
// Optimal cost of two agents by breadth-first search over joint states, one layer per time step.
//
// As long as neither agent rests, both pay for every step. All paths to a joint state at time t
// therefore cost 2t, and breadth-first search finds the earliest t. The agent that rests first does
// so at some time t in some joint state. From then on its place is blocked, and a second
// breadth-first search finds the other agent's cheapest path to its rest. The optimum is the
// minimum of 2t plus the cost of that path, over all joint states and both choices of the agent
// that rests first. The earliest time suffices for each joint state, because an agent that reaches
// a state later has no additional choices there.
#include "tests/oracle/layered_search.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "tests/oracle/steps.h"

namespace grove::detail::oracle {
namespace {

// State of an agent with its remaining tasks, each with its remaining steps (0 for a task that
// takes no time).
struct Walker {
  Place cell;
  Heading heading;
  Heading turning_to;
  Time turned;
  std::map<TaskIndex, Time> left;
  TaskIndex at_work;  // the task that it must continue; -1: none
  auto operator<=>(const Walker&) const = default;
};

void arrive(const Instance& instance, Walker& walker, Place cell) {
  walker.cell = cell;
  std::erase_if(walker.left, [&](const auto& task) {
    return instance.task(task.first).duration == 0 && instance.task(task.first).cell == cell;
  });
}

bool is_home(const Instance& instance, AgentIndex agent, const Walker& walker) {
  if (!walker.left.empty()) return false;
  const Agent& spec = instance.agent(agent);
  if (spec.goal) {
    if (walker.cell != *spec.goal) return false;
    return !spec.goal_heading || (walker.turned == 0 && walker.heading == *spec.goal_heading);
  }
  return spec.tasks.empty() || std::ranges::any_of(spec.tasks, [&](TaskIndex task) {
           return instance.task(task).cell == walker.cell;
         });
}

using Steps = std::vector<std::vector<Place>>;

// Returns the state after one step of executing `task`.
Walker after_task_step(const Walker& walker, TaskIndex task) {
  Walker then = walker;
  Time& left = then.left.at(task);
  --left;
  then.at_work = left > 0 ? task : -1;
  if (left == 0) then.left.erase(task);
  return then;
}

Walker turned(const Instance& instance, AgentIndex agent, Walker walker, Heading to) {
  walker.turning_to = to;
  if (++walker.turned < instance.agent(agent).motion.turn_steps) return walker;
  walker.heading = walker.turning_to = to;
  walker.turned = 0;
  return walker;
}

bool faces(const Instance& instance, const Walker& walker, Place cell) {
  const Position a = instance.grid().position(walker.cell);
  const Position b = instance.grid().position(cell);
  const Position ahead{b.x - a.x, b.y - a.y};
  switch (walker.heading) {
    case Heading::kNorth:
      return ahead == Position{0, -1};
    case Heading::kEast:
      return ahead == Position{1, 0};
    case Heading::kSouth:
      return ahead == Position{0, 1};
    default:
      return ahead == Position{-1, 0};
  }
}

std::vector<Walker> steps(const Instance& instance, const Steps& map, AgentIndex agent,
                          const Walker& walker) {
  const bool turns = instance.agent(agent).motion.turn_steps > 0;
  std::vector<Walker> next;
  if (walker.at_work >= 0) return {after_task_step(walker, walker.at_work)};
  for (const auto& [task, left] : walker.left)
    if (instance.task(task).duration > 0 && instance.task(task).cell == walker.cell)
      next.push_back(after_task_step(walker, task));
  next.push_back(walker);
  if (walker.turned > 0) {
    next.push_back(turned(instance, agent, walker, walker.turning_to));
    return next;
  }
  for (Place cell : map[walker.cell]) {
    if (turns && !faces(instance, walker, cell)) continue;
    next.push_back(walker);
    arrive(instance, next.back(), cell);
  }
  if (turns) {
    next.push_back(turned(instance, agent, walker, right_of(walker.heading)));
    next.push_back(turned(instance, agent, walker, left_of(walker.heading)));
  }
  return next;
}

Walker at_start(const Instance& instance, AgentIndex agent) {
  const Agent& spec = instance.agent(agent);
  const Pose pose = instance.pose_of(spec.start);
  Walker walker{pose.place, pose.heading, pose.to, pose.steps, {}, -1};
  for (TaskIndex task : spec.tasks) walker.left[task] = instance.task(task).duration;
  arrive(instance, walker, pose.place);
  if (instance.world().is_working(spec.start)) {
    const Work& work = instance.world().work(spec.start);
    walker.left[work.task] -= work.done;
    walker.at_work = work.task;
  }
  return walker;
}

// Returns the least number of steps until `walker` may rest while `wall` is blocked forever, or
// nullopt if it can never rest.
std::optional<Cost> steps_to_rest(const Instance& instance, const Steps& map, AgentIndex agent,
                                  const Walker& walker, Place wall) {
  std::set<Walker> seen{walker};
  std::vector<Walker> layer{walker};
  for (Cost time = 0; !layer.empty(); ++time) {
    std::vector<Walker> next_layer;
    for (const Walker& now : layer) {
      if (is_home(instance, agent, now)) return time;
      for (const Walker& next : steps(instance, map, agent, now))
        if (next.cell != wall && seen.insert(next).second) next_layer.push_back(next);
    }
    layer = std::move(next_layer);
  }
  return std::nullopt;
}

using Pair = std::pair<Walker, Walker>;

bool collide(const Pair& from, const Pair& to) {
  const bool swap = to.first.cell == from.second.cell && to.second.cell == from.first.cell;
  return swap || to.first.cell == to.second.cell;
}

// Returns the least cost from `pair` on if one of the two agents rests there immediately; nullopt
// if that is impossible.
std::optional<Cost> cost_after_first_rest(const Instance& instance, const Steps& map,
                                          const Pair& pair) {
  std::optional<Cost> best;
  const auto consider = [&](AgentIndex rests, const Walker& resting, const Walker& moving) {
    if (!is_home(instance, rests, resting)) return;
    const auto cost = steps_to_rest(instance, map, 1 - rests, moving, resting.cell);
    if (cost && (!best || *cost < *best)) best = cost;
  };
  consider(0, pair.first, pair.second);
  consider(1, pair.second, pair.first);
  return best;
}

}  // namespace

std::optional<Cost> solve_two_agents(const Instance& instance) {
  const Steps map = steps_on(instance.map());
  const Pair start{at_start(instance, 0), at_start(instance, 1)};
  std::set<Pair> seen{start};
  std::vector<Pair> layer{start};
  std::optional<Cost> best;
  for (Cost time = 0; !layer.empty(); ++time) {
    std::vector<Pair> next_layer;
    for (const Pair& now : layer) {
      const auto rest = cost_after_first_rest(instance, map, now);
      if (rest && (!best || 2 * time + *rest < *best)) best = 2 * time + *rest;
      for (const Walker& first : steps(instance, map, 0, now.first))
        for (const Walker& second : steps(instance, map, 1, now.second))
          if (const Pair next{first, second}; !collide(now, next) && seen.insert(next).second)
            next_layer.push_back(next);
    }
    layer = std::move(next_layer);
  }
  return best;
}

}  // namespace grove::detail::oracle
