// SPDX-License-Identifier: MIT
// Four arguments, each a proof that there is no plan:
//
// Reach. An agent cannot visit or rest on a place to which there is no way from its start.
//
// Order. Of two places that an agent must visit one comes first, and from there is a way to the
// other; from all of them there is one to its destination. (Where every step can be undone that
// follows from reach. If it holds of all pairs, there is an order in which the agent, alone, can
// visit all: the places in an order of "is there a way to".)
//
// Rest. Agents rest on different cells for ever: a CTS agent on its destination, an MG agent on one
// of its own tasks. If the bipartite graph of agents and cells to rest on has no matching that
// covers every agent, there is no plan (Hall 1935; found by augmenting paths).
//
// Corridor. In a component that is a simple path agents cannot pass each other: two next to each
// other would have to share a cell or swap. So the order along the corridor never changes; an agent
// with r agents on one side is never nearer than r cells to that end, and destinations lie in the
// order of the starts.
#include "grove/search/feasibility.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <vector>

namespace grove {
namespace {

// The cells that an agent must stand on at some time, its start aside.
std::vector<Cell> required_cells(const Instance& instance, const Agent& agent) {
  std::vector<Cell> cells;
  for (TaskIndex task : agent.tasks) cells.push_back(instance.task(task).cell);
  if (agent.goal) cells.push_back(*agent.goal);
  return cells;
}

std::optional<std::string> unreachable_cell(const Problem& problem) {
  for (const Agent& agent : problem.instance.agents())
    for (Cell cell : required_cells(problem.instance, agent))
      if (problem.distances.to(cell)[agent.start] == kNever)
        return fmt::format("agent '{}' cannot reach cell {}: there is no way from its start",
                           agent.id, problem.instance.world().name(cell));
  return std::nullopt;
}

std::optional<std::string> no_order(const Problem& problem, const Agent& agent) {
  const World& world = problem.instance.world();
  const auto leads = [&](Place from, Place to) { return problem.distances.to(to)[from] < kNever; };
  for (TaskIndex a : agent.tasks) {
    const Place here = problem.instance.task(a).cell;
    for (TaskIndex b : agent.tasks)
      if (const Place there = problem.instance.task(b).cell;
          !leads(here, there) && !leads(there, here))
        return fmt::format(
            "agent '{}' cannot visit both {} and {}: no way leads from one to the "
            "other",
            agent.id, world.name(here), world.name(there));
    if (agent.goal && !leads(here, *agent.goal))
      return fmt::format("agent '{}' cannot go on from {} to its goal {}: there is no way",
                         agent.id, world.name(here), world.name(*agent.goal));
  }
  return std::nullopt;
}

std::optional<std::string> agent_without_an_order(const Problem& problem) {
  if (problem.instance.world().is_plain()) return std::nullopt;
  for (const Agent& agent : problem.instance.agents())
    if (auto reason = no_order(problem, agent)) return reason;
  return std::nullopt;
}

// Kuhn's algorithm: agents to distinct cells to rest on.
class RestingMatching {
 public:
  explicit RestingMatching(const Instance& instance) : instance_(instance) {}

  bool place(AgentIndex agent) {
    tried_.clear();
    return augment(agent);
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
  std::map<Cell, AgentIndex> holder_;
  std::map<Cell, bool> tried_;
};

std::optional<std::string> no_room_to_rest(const Problem& problem) {
  RestingMatching matching(problem.instance);
  for (AgentIndex agent = 0; agent < problem.instance.agent_count(); ++agent)
    if (!matching.place(agent))
      return fmt::format(
          "the agents cannot all end on different cells: none is left for agent '{}'",
          problem.instance.agent(agent).id);
  return std::nullopt;
}

// The places of the corridor that ends at `end`, in order; empty if the component is no simple
// path.
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

  std::vector<const Agent*> agents;
  for (const Agent& agent : instance.agents())
    if (place.contains(agent.start)) agents.push_back(&agent);
  std::ranges::sort(agents, {}, [&](const Agent* agent) { return place[agent->start]; });

  const int count = static_cast<int>(agents.size());
  int last_goal = -1;
  for (int r = 0; r < count; ++r) {
    const Agent& agent = *agents[r];
    for (Cell cell : required_cells(instance, agent))
      if (place[cell] < r || place[cell] > length - (count - r))
        return fmt::format("agent '{}' cannot get to cell {}: other agents fill the corridor",
                           agent.id, instance.world().name(cell));
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

std::optional<std::string> evident_infeasibility(const Problem& problem) {
  if (auto reason = unreachable_cell(problem)) return reason;
  if (auto reason = agent_without_an_order(problem)) return reason;
  if (auto reason = no_room_to_rest(problem)) return reason;
  return stuck_in_a_corridor(problem);
}

}  // namespace grove
