// SPDX-License-Identifier: MIT
// As long as neither agent rests, both pay for every step: all ways to a joint state at time t cost
// 2t, and breadth-first search by layers of time finds the earliest. Whichever agent rests first
// does so at some time t in some joint state; from there on it is a wall, and the other's cheapest
// way home is a breadth-first search of its own. The optimum is the least 2t + that way, over all
// joint states and both agents. An agent that reaches a state later has no more choices there than
// one that reached it earlier, so the earliest time is enough.
#include "tests/oracle/layered_search.h"

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "tests/oracle/steps.h"

namespace grove::oracle {
namespace {

struct Walker {
  Place cell;
  std::set<Place> to_visit;
  auto operator<=>(const Walker&) const = default;
};

void arrive(Walker& walker, Place cell) {
  walker.cell = cell;
  walker.to_visit.erase(cell);
}

bool is_home(const Instance& instance, AgentIndex agent, const Walker& walker) {
  if (!walker.to_visit.empty()) return false;
  if (const auto goal = instance.agent(agent).goal) return walker.cell == *goal;
  return std::ranges::any_of(instance.agent(agent).tasks, [&](TaskIndex task) {
    return instance.task(task).cell == walker.cell;
  });
}

using Steps = std::vector<std::vector<Place>>;

std::vector<Walker> steps(const Steps& map, const Walker& walker) {
  std::vector<Walker> next{walker};
  for (Place cell : map[walker.cell]) {
    next.push_back(walker);
    arrive(next.back(), cell);
  }
  return next;
}

Walker at_start(const Instance& instance, AgentIndex agent) {
  Walker walker{kNoPlace, {}};
  for (TaskIndex task : instance.agent(agent).tasks)
    walker.to_visit.insert(instance.task(task).cell);
  arrive(walker, instance.agent(agent).start);
  return walker;
}

// Steps until `walker` is home, with `wall` blocked for good; none when it cannot be.
std::optional<Cost> way_home(const Instance& instance, const Steps& map, AgentIndex agent,
                             const Walker& walker, Place wall) {
  std::set<Walker> seen{walker};
  std::vector<Walker> layer{walker};
  for (Cost time = 0; !layer.empty(); ++time) {
    std::vector<Walker> next_layer;
    for (const Walker& now : layer) {
      if (is_home(instance, agent, now)) return time;
      for (const Walker& next : steps(map, now))
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

// The least cost from `pair` on when one of the two rests there at once.
std::optional<Cost> cost_after_first_rest(const Instance& instance, const Steps& map,
                                          const Pair& pair) {
  std::optional<Cost> best;
  const auto consider = [&](AgentIndex rests, const Walker& resting, const Walker& moving) {
    if (!is_home(instance, rests, resting)) return;
    const auto cost = way_home(instance, map, 1 - rests, moving, resting.cell);
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
      for (const Walker& first : steps(map, now.first))
        for (const Walker& second : steps(map, now.second))
          if (const Pair next{first, second}; !collide(now, next) && seen.insert(next).second)
            next_layer.push_back(next);
    }
    layer = std::move(next_layer);
  }
  return best;
}

}  // namespace grove::oracle
