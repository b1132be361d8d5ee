// SPDX-License-Identifier: MIT
// Presolve: five arguments, each of which proves that there is no plan.
//
// *Reach.* An agent cannot visit or rest on a place that is unreachable from its start.
//
// *Order.* Of any two required places an agent visits one first, so the other must be reachable
// from it. Its destination must be reachable from all required places. (Where every step can be
// undone, this follows from *Reach*. If the condition holds for all pairs, an agent without other
// agents can visit all its places in some order.)
//
// *Rest.* Agents rest on different cells forever: a CTS agent on its destination, an MG agent on
// one of its own tasks. (An idle agent can rest anywhere, and a place for it is always left.) If
// the bipartite graph of agents and resting cells has no matching that covers every agent, there is
// no plan (Hall 1935). The matching is computed with augmenting paths.
//
// *Corridor.* In a component that is a simple path, agents cannot pass each other, because two
// adjacent agents would have to share a cell or swap. Their order along the corridor therefore
// never changes. An agent with r agents between itself and one end is always at least r cells from
// that end, and the destinations lie in the order of the starts.
//
// *Pebble motion.* See pebble_motion.cpp.
#include "search/feasibility.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <vector>

#include "model/assert.h"
#include "search/pebble_motion.h"

namespace grove::detail {
namespace {

// The cells that an agent must occupy at some time, except for its start.
std::vector<Cell> required_cells(const Instance& instance, const Agent& agent) {
  std::vector<Cell> cells;
  for (TaskIndex task : agent.tasks) cells.push_back(instance.task(task).cell);
  if (agent.goal) cells.push_back(*agent.goal);
  return cells;
}

std::optional<std::string> unreachable_cell(const Problem& problem) {
  const Instance& instance = problem.instance;
  for (AgentIndex i = 0; i < instance.agent_count(); ++i) {
    const Agent& agent = instance.agent(i);
    const auto no_way = [&](DistanceView to) { return to[agent.start] == kNever; };
    const auto reason = [&](Place place) {
      return fmt::format("agent '{}' cannot reach {}: there is no path from its start", agent.id,
                         instance.world().name(place));
    };
    for (const TaskIndex task : agent.stops)
      if (no_way(problem.distances.to_task(task))) return reason(instance.task(task).cell);
    if (agent.goal && no_way(problem.distances.to_rest(i))) return reason(*agent.goal);
  }
  return std::nullopt;
}

std::optional<std::string> no_order(const Problem& problem, AgentIndex index) {
  const World& world = problem.instance.world();
  const Agent& agent = problem.instance.agent(index);
  const auto leads = [&](Place from, DistanceView to) {
    return min_distance_from(world, from, agent.kind, to) < kNever;
  };
  for (TaskIndex a : agent.stops) {
    const Place here = problem.instance.task(a).cell;
    for (TaskIndex b : agent.stops)
      if (const Place there = problem.instance.task(b).cell;
          !leads(here, problem.distances.to_task(b)) && !leads(there, problem.distances.to_task(a)))
        return fmt::format(
            "agent '{}' cannot visit both {} and {}: no path leads from one to the other", agent.id,
            world.name(here), world.name(there));
    if (agent.goal && !leads(here, problem.distances.to_rest(index)))
      return fmt::format("agent '{}' cannot continue from {} to its goal {}: there is no path",
                         agent.id, world.name(here), world.name(*agent.goal));
  }
  return std::nullopt;
}

std::optional<std::string> agent_without_an_order(const Problem& problem) {
  if (problem.instance.world().is_plain()) return std::nullopt;
  for (AgentIndex agent = 0; agent < problem.instance.agent_count(); ++agent)
    if (auto reason = no_order(problem, agent)) return reason;
  return std::nullopt;
}

// Bipartite matching of agents to distinct resting cells (Kuhn's algorithm).
class RestingMatching {
 public:
  explicit RestingMatching(const Instance& instance) : instance_(instance) {}

  bool place(AgentIndex agent) {
    tried_.clear();
    const bool is_placed = augment(agent);
    GROVE_ASSERT(std::ranges::all_of(holder_,
                                     [&](const auto& held) {
                                       return std::ranges::count(holder_, held.second,
                                                                 &Holders::value_type::second) == 1;
                                     }),
                 "each agent rests on one cell");
    return is_placed;
  }

 private:
  std::vector<Cell> resting_cells(AgentIndex agent) const {
    if (const auto goal = instance_.agent(agent).goal) return {*goal};
    return required_cells(instance_, instance_.agent(agent));
  }

  bool augment(AgentIndex agent) {
    for (Cell cell : resting_cells(agent)) {
      if (!tried_.emplace(cell, true).second) continue;
      const auto holder = holder_.find(cell);
      if (holder != holder_.end() && !augment(holder->second)) continue;
      holder_[cell] = agent;
      return true;
    }
    return false;
  }

  const Instance& instance_;
  using Holders = std::map<Cell, AgentIndex>;
  Holders holder_;
  std::map<Cell, bool> tried_;
};

std::optional<std::string> no_room_to_rest(const Problem& problem) {
  RestingMatching matching(problem.instance);
  for (AgentIndex agent = 0; agent < problem.instance.agent_count(); ++agent)
    if (!problem.instance.agent(agent).is_idle() && !matching.place(agent))
      return fmt::format(
          "the agents cannot all end on distinct cells: no cell is left for agent '{}'",
          problem.instance.agent(agent).id);
  return std::nullopt;
}

// Returns the places of the corridor that ends at `end`, in order; empty if the component is not a
// simple path.
std::vector<Place> corridor_from(const World& world, Place end) {
  std::vector<Place> places{end};
  Place previous = kNoPlace;
  while (true) {
    const auto neighbors = world.neighbors(places.back());
    if (neighbors.size() > 2) return {};
    const auto next = std::ranges::find_if(neighbors, [&](Place p) { return p != previous; });
    if (next == neighbors.end()) return places;
    previous = places.back();
    places.push_back(*next);
  }
}

std::optional<std::string> stuck_in(const Problem& problem, const std::vector<Place>& corridor) {
  const Instance& instance = problem.instance;
  const int length = static_cast<int>(corridor.size());
  std::map<Place, int> place;
  for (int i = 0; i < length; ++i) place[corridor[i]] = i;

  const auto start = [&](const Agent& agent) { return instance.world().place(agent.start); };
  std::vector<const Agent*> agents;
  for (const Agent& agent : instance.agents())
    if (place.contains(start(agent))) agents.push_back(&agent);
  std::ranges::sort(agents, {}, [&](const Agent* agent) { return place[start(*agent)]; });

  const int count = static_cast<int>(agents.size());
  int last_goal = -1;
  for (int r = 0; r < count; ++r) {
    const Agent& agent = *agents[r];
    for (Cell cell : required_cells(instance, agent))
      if (place[cell] < r || place[cell] > length - (count - r))
        return fmt::format("agent '{}' cannot reach {}: other agents fill the corridor", agent.id,
                           instance.world().name(cell));
    if (!agent.goal) continue;
    if (place[*agent.goal] < last_goal)
      return fmt::format("agent '{}' would have to pass another agent in a corridor", agent.id);
    last_goal = place[*agent.goal];
  }
  return std::nullopt;
}

std::optional<std::string> stuck_in_a_corridor(const Problem& problem) {
  const World& world = problem.instance.world();
  for (Place place = 0; place < world.place_count(); ++place) {
    if (world.neighbors(place).size() > 1) continue;
    const std::vector<Place> corridor = corridor_from(world, place);
    if (corridor.empty()) continue;
    if (auto reason = stuck_in(problem, corridor)) return reason;
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> presolve_infeasibility(const Problem& problem) {
  if (auto reason = unreachable_cell(problem)) return reason;
  if (auto reason = agent_without_an_order(problem)) return reason;
  if (auto reason = no_room_to_rest(problem)) return reason;
  if (auto reason = stuck_in_a_corridor(problem)) return reason;
  return pebble_motion_infeasibility(problem.instance);
}

}  // namespace grove::detail
