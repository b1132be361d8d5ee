// SPDX-License-Identifier: MIT
// Writers for the formats of libMultiRobotPlanning, mapf-visualizer and EECBS. The other writers
// are in planviz_file.cpp and robot_paths.cpp.
#include "io/plan_export.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <ranges>

#include "io/atomic_file.h"
#include "io/format_support.h"
#include "io/plan_steps.h"
#include "io/yaml_text.h"
#include "model/distance_field.h"

namespace grove::detail {
namespace {

// Returns a line with `key` and the value of the counter `name`; "" if there is no such counter.
std::string count_line(const Stats& stats, const std::string& name, std::string_view key) {
  const auto it = stats.counts.find(name);
  return it == stats.counts.end() ? "" : fmt::format("  {}: {}\n", key, it->second);
}

std::string statistics_text(const Solution& solution) {
  const Stats& stats = solution.stats;
  std::string text = fmt::format("statistics:\n  cost: {}\n  makespan: {}\n", solution.plan->cost,
                                 makespan(*solution.plan));
  if (const auto it = stats.measures.find("wall_s"); it != stats.measures.end())
    text += fmt::format("  runtime: {}\n", it->second);
  return text + count_line(stats, "nodes_expanded", "highLevelExpanded") +
         count_line(stats, "low_level_expanded", "lowLevelExpanded");
}

void add_steps(std::string& text, const Grid& grid, const Path& path) {
  const auto steps = until_rest(path);
  for (std::size_t t = 0; t < steps.size(); ++t) {
    const Position p = grid.position(steps[t]);
    fmt::format_to(std::back_inserter(text), "    - x: {}\n      y: {}\n      t: {}\n", p.x, p.y,
                   t);
  }
}

// YAML limits simple keys to this number of characters.
constexpr std::size_t kMaxKeyLength = 1024;

std::string key_text(const Instance& instance, AgentIndex agent) {
  std::string key = yaml_text(instance.agent(agent).id);
  if (key.size() > kMaxKeyLength)
    throw NotRepresentable(
        fmt::format("agents/{}", agent),
        fmt::format("the id has {} bytes in YAML, where it is a key; expected at most {}",
                    key.size(), kMaxKeyLength),
        Loss::kNothing);
  return key;
}

}  // namespace

void write_libmrp_schedule(const std::filesystem::path& path, const Instance& instance,
                           const Solution& solution) {
  constexpr std::string_view kFormat = "libMultiRobotPlanning's schedule";
  require_free_grid(instance, kFormat);
  require_fixed_tasks(instance, kFormat);
  std::string text = statistics_text(solution) + "schedule:\n";
  for (AgentIndex i = 0; i < instance.agent_count(); ++i) {
    text += fmt::format("  {}:\n", key_text(instance, i));
    add_steps(text, instance.grid(), solution.plan->agents[i].path);
  }
  write_file_atomically(path, text);
}

namespace {

// Appends a position. The comma is required, because mapf-visualizer finds only positions that a
// comma follows.
void add_position(std::string& text, const Grid& grid, Cell cell) {
  const Position p = grid.position(cell);
  fmt::format_to(std::back_inserter(text), "({},{}),", p.x, p.y);
}

// The agent's sum of loss: the number of time steps that are not waits on its last cell. Such waits
// do not count even if the agent leaves the cell again later.
Cost loss(const Path& path) {
  Cost steps = 0;
  for (std::size_t t = 1; t < path.size(); ++t)
    steps += path[t - 1] != path.back() || path[t] != path.back();
  return steps;
}

// A lower bound on the finish time: the maximum distance from the start to a task that the agent
// must visit, or to the nearest destination.
Time farthest_stop(const Instance& instance, const Agent& agent) {
  const DistanceField distance = distance_field(instance.grid(), agent.start);
  Time farthest = agent.goal ? distance[*agent.goal] : 0;
  if (!agent.goals.empty())
    farthest = std::ranges::min(
        agent.goals | std::views::transform([&](Place goal) -> Time { return distance[goal]; }));
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
  constexpr std::string_view kFormat = "mapf-visualizer's text";
  require_free_grid(instance, kFormat);
  require_fixed_tasks(instance, kFormat);
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

void write_path_lists(const std::filesystem::path& path, const Instance& instance,
                      const Solution& solution) {
  constexpr std::string_view kFormat = "EECBS's path lists";
  require_free_grid(instance, kFormat);
  require_fixed_tasks(instance, kFormat);
  std::string text;
  for (AgentIndex i = 0; i < instance.agent_count(); ++i) {
    text += fmt::format("Agent {}: ", i);
    for (Cell cell : until_rest(solution.plan->agents[i].path)) {
      const Position p = instance.grid().position(cell);
      fmt::format_to(std::back_inserter(text), "({},{})->", p.y, p.x);
    }
    text += '\n';
  }
  write_file_atomically(path, text);
}

}  // namespace grove::detail
