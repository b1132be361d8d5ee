// SPDX-License-Identifier: MIT
#include "search/audit.h"

#include <fmt/format.h>

#include <algorithm>

#include "model/assert.h"

namespace grove::detail {
namespace {

template <class... Args>
void require(bool holds, fmt::format_string<Args...> what, Args&&... args) {
  if (!holds) throw AssertionFailed("audit: " + fmt::format(what, std::forward<Args>(args)...));
}

bool is_step(const World& world, State from, State to) {
  return from == to || std::ranges::count(world.moves(from), to) > 0;
}

// An agent without a destination may also rest on an optional task that it has visited.
bool may_rest_at_end(const Instance& instance, AgentIndex index, State state) {
  const Agent& agent = instance.agent(index);
  const auto is_here = [&](TaskIndex task) {
    return instance.task(task).cell == instance.world().place(state);
  };
  return instance.may_rest(index, state) ||
         (!agent.has_destination() && std::ranges::any_of(agent.options, is_here));
}

void audit_walk(const Instance& instance, AgentIndex index, const Path& path) {
  const Agent& agent = instance.agent(index);
  const World& world = instance.world();
  require(!path.empty() && path.front() == agent.start, "agent {} begins elsewhere", index);
  for (std::size_t t = 1; t < path.size(); ++t)
    require(is_step(world, path[t - 1], path[t]), "agent {} makes no step at time {}", index, t);
  const auto visited = [&](TaskIndex task) {
    return std::ranges::any_of(path, [&](State state) { return instance.is_visited(task, state); });
  };
  require(std::ranges::all_of(agent.tasks, visited), "agent {} leaves a task out", index);
  require(may_rest_at_end(instance, index, path.back()), "agent {} ends where it may not", index);
}

}  // namespace

void audit(const Problem& problem, const Node& node, std::span<const AgentIndex> scope) {
  std::vector<Path> paths;
  std::vector<std::vector<Constraint>> constraints;
  node.paths(problem, paths);
  node.constraints(constraints);
  Cost cost = 0;
  for (AgentIndex agent = 0; agent < static_cast<AgentIndex>(paths.size()); ++agent) {
    audit_walk(problem.instance, agent, paths[agent]);
    cost += static_cast<Cost>(paths[agent].size()) - 1;
  }
  for (const AgentIndex agent : scope)
    for (const Constraint& c : constraints[agent])
      require(satisfies(problem.instance.world(), paths[agent], c, problem.corridors),
              "agent {} does not satisfy '{}' on place {}, times {} to {}", agent, name_of(c.kind),
              c.cell, c.begin, c.end);
  require(node.cost() == cost, "a node says that it costs {}, its paths {}", node.cost(), cost);
  require(node.bound() >= cost, "a node's bound {} is below its cost {}", node.bound(), cost);
  if (!node.is_root())
    require(node.bound() >= node.parent()->bound(), "the bound falls from a parent's {} to {}",
            node.parent()->bound(), node.bound());
}

void audit(const Problem& problem, const ConflictAvoidanceTable& table,
           std::span<const Path> paths) {
  ConflictAvoidanceTable recomputed(problem.instance.world());
  for (const Path& path : paths) recomputed.add(path);
  for (std::size_t agent = 0; agent < paths.size(); ++agent) {
    if (paths[agent].empty()) continue;
    const int shown = table.conflicts_of(paths[agent]);
    const int there = recomputed.conflicts_of(paths[agent]);
    require(shown == there, "the table of paths sees {} conflicts of agent {}, there are {}", shown,
            agent, there);
  }
}

}  // namespace grove::detail
