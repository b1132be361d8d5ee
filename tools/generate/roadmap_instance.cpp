// SPDX-License-Identifier: MIT
#include "tools/generate/roadmap_instance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <numeric>
#include <utility>
#include <vector>

#include "io/input_error.h"
#include "tools/generate/components.h"
#include "tools/generate/instance_draft.h"
#include "tools/generate/random.h"

namespace grove::detail {
namespace {

using Vertices = std::vector<int>;  // in ascending order until they are shuffled

Vertices with_prefix(const Roadmap& roadmap, Vertices vertices, const std::string& prefix) {
  std::erase_if(vertices, [&](int v) { return !roadmap.vertices()[v].id.starts_with(prefix); });
  return vertices;
}

// Returns the elements of `vertices` whose roads all lead to the same other vertex.
Vertices dead_ends(const Roadmap& roadmap, const Vertices& vertices) {
  std::vector<Vertices> neighbors(roadmap.vertices().size());
  const auto add = [&](int at, int neighbor) {
    if (at != neighbor && std::ranges::count(neighbors[at], neighbor) == 0)
      neighbors[at].push_back(neighbor);
  };
  for (const Road& road : roadmap.roads()) {
    add(road.from, road.to);
    add(road.to, road.from);
  }
  Vertices found;
  std::ranges::copy_if(vertices, std::back_inserter(found),
                       [&](int v) { return neighbors[v].size() == 1; });
  return found;
}

Vertices without(const Vertices& vertices, Vertices others) {
  std::ranges::sort(others);
  Vertices rest;
  std::ranges::set_difference(vertices, others, std::back_inserter(rest));
  return rest;
}

// Candidate vertices for starts and goals of agents, and for tasks.
struct Choice {
  Vertices agents;
  Vertices tasks;
};

Vertices choose_for_agents(const Site& site, const Vertices& all, int agents) {
  if (site.agents_on) return with_prefix(site.roadmap, all, *site.agents_on);
  Vertices ends = dead_ends(site.roadmap, all);
  return std::ssize(ends) >= agents ? ends : all;
}

Choice choose(const Site& site, int agents) {
  const Vertices all = largest_strong_component(site.roadmap);
  const Vertices for_agents = choose_for_agents(site, all, agents);
  if (site.tasks_on) return {for_agents, with_prefix(site.roadmap, all, *site.tasks_on)};
  return {for_agents, for_agents == all ? all : without(all, for_agents)};
}

void require(const Site& site, const Vertices& vertices, int count, const std::string& what,
             const std::optional<std::string>& prefix, const std::string& besides = "") {
  if (std::ssize(vertices) >= count) return;
  const std::string named = prefix ? fmt::format(" whose ids begin with '{}'", *prefix) : "";
  throw InputError(site.name, "",
                   fmt::format("has {} vertices{} that can all reach each other{}; expected at "
                               "least {} for {} {}",
                               vertices.size(), named, besides, count, count, what));
}

std::vector<DrawnAgent> draw_agents(const Site& site, Vertices starts, int count, Random& random) {
  require(site, starts, count, "agents", site.agents_on);
  Vertices goals = starts;
  random.shuffle(starts);
  random.shuffle(goals);
  // If an agent's goal is its start, swaps it with the next agent's goal. Afterwards both goals
  // differ from the starts of their agents, because starts are distinct and goals are distinct.
  // (With one vertex this changes nothing.)
  for (std::size_t k = 0; k < goals.size(); ++k)
    if (goals[k] == starts[k]) std::swap(goals[k], goals[(k + 1) % goals.size()]);
  std::vector<DrawnAgent> agents;
  for (int k = 0; k < count; ++k)
    agents.push_back(
        {"", site.roadmap.place_of_vertex(starts[k]), site.roadmap.place_of_vertex(goals[k])});
  return agents;
}

Vertices draw_task_vertices(const Site& site, const Vertices& from,
                            const std::vector<DrawnAgent>& agents, int count, Random& random) {
  Vertices starts;
  for (const DrawnAgent& agent : agents) starts.push_back(site.roadmap.spot(agent.start).vertex);
  Vertices vertices = without(from, starts);
  require(site, vertices, count, "tasks", site.tasks_on, " and where no agent starts");
  random.shuffle(vertices);
  vertices.resize(count);
  return vertices;
}

}  // namespace

Instance generate_instance(const Site& site, const InstanceRequest& request) {
  const Choice choice = choose(site, request.agents);
  Random random = random_for(RandomUse::kScenario, request.seed);
  std::vector<DrawnAgent> agents = draw_agents(site, choice.agents, request.agents, random);
  const Vertices tasks = draw_task_vertices(site, choice.tasks, agents, request.tasks, random);
  InstanceDraft draft(site.name, std::move(agents), request);
  Vertices all(request.agents);
  std::iota(all.begin(), all.end(), 0);
  for (const int vertex : tasks) draft.add_task(site.roadmap.place_of_vertex(vertex), all);
  return std::move(draft).build(site.roadmap);
}

}  // namespace grove::detail
