// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "io/atomic_file.h"
#include "io/format_support.h"
#include "io/plan_export.h"
#include "io/plan_steps.h"
#include "model/distance_field.h"

namespace grove::detail {
namespace {

// mapf-visualizer finds only positions that are followed by a comma.
void add_position(std::string& text, const Grid& grid, Cell cell) {
  const Position p = grid.position(cell);
  fmt::format_to(std::back_inserter(text), "({},{}),", p.x, p.y);
}

// The number of steps that are not waits on the agent's last cell. Such waits do not count even if
// the agent leaves the cell again later.
Cost loss(const Path& path) {
  Cost steps = 0;
  for (std::size_t t = 1; t < path.size(); ++t)
    steps += path[t - 1] != path.back() || path[t] != path.back();
  return steps;
}

// A lower bound on the finish time: the maximum distance to a task or the destination.
Time farthest_stop(const Instance& instance, const Agent& agent) {
  const DistanceField distance = distance_field(instance.grid(), agent.start);
  Time farthest = agent.goal ? distance[*agent.goal] : 0;
  for (TaskIndex task : agent.tasks)
    farthest = std::max(farthest, distance[instance.task(task).cell]);
  return farthest;
}

std::string head_text(const Instance& instance, const Solution& solution, const std::string& map) {
  Cost sum_of_loss = 0;
  for (const AgentPlan& agent : solution.plan->agents) sum_of_loss += loss(agent.path);
  Cost sum_of_farthest = 0;
  Time farthest = 0;
  for (const Agent& agent : instance.agents()) {
    const Time time = farthest_stop(instance, agent);
    sum_of_farthest += time;
    farthest = std::max(farthest, time);
  }
  std::string text = fmt::format(
      "agents={}\nmap_file={}\nsolver=grove\nsolved=1\nsoc={}\nsoc_lb={}\nmakespan={}\n"
      "makespan_lb={}\nsum_of_loss={}\nsum_of_loss_lb={}\n",
      instance.agent_count(), map, solution.plan->cost, solution.lower_bound,
      makespan(*solution.plan), farthest, sum_of_loss, sum_of_farthest);
  const Stats& stats = solution.stats;
  if (const auto it = stats.measures.find("wall_s"); it != stats.measures.end())
    text += fmt::format("comp_time={}\n", it->second * 1000);  // in milliseconds
  if (const auto it = stats.counts.find("seed"); it != stats.counts.end())
    text += fmt::format("seed={}\n", it->second);
  return text;
}

}  // namespace

void write_visualizer_text(const std::filesystem::path& path, const Instance& instance,
                           const Solution& solution, const std::string& map) {
  require_free_grid(instance, "mapf-visualizer's text");
  const Grid& grid = instance.grid();
  const std::vector<AgentPlan>& agents = solution.plan->agents;
  std::string text = head_text(instance, solution, map);
  text += "starts=";
  for (const AgentPlan& agent : agents) add_position(text, grid, agent.path.front());
  text += "\ngoals=";
  for (const AgentPlan& agent : agents) add_position(text, grid, agent.path.back());
  text += "\nsolution=\n";
  for (Time t = 0; t <= makespan(*solution.plan); ++t) {
    text += fmt::format("{}:", t);
    for (const AgentPlan& agent : agents) add_position(text, grid, state_at(agent.path, t));
    text += '\n';
  }
  write_file_atomically(path, text);
}

}  // namespace grove::detail
