// SPDX-License-Identifier: MIT
// Small instances on maps given as text.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/instance.h"

namespace grove::detail::testing {

// Returns the grid with these rows of '.' (passable) and '@' (blocked).
inline Grid grid_of(const std::vector<std::string>& rows) {
  std::vector<bool> passable;
  for (const std::string& row : rows)
    for (char c : row) passable.push_back(c == '.');
  return Grid(static_cast<int>(rows[0].size()), static_cast<int>(rows.size()), passable);
}

struct AgentSpec {
  Position start;
  std::optional<Position> goal;
  std::vector<Position> tasks = {};
};

// Returns an instance with agents a0, a1, ... on a grid. Agents that name the same task cell share
// one task.
inline Instance instance_of(const std::vector<std::string>& rows,
                            const std::vector<AgentSpec>& agents) {
  const Grid grid = grid_of(rows);
  InstanceBuilder builder(grid);
  std::vector<std::pair<Position, std::vector<std::string>>> tasks;
  for (std::size_t i = 0; i < agents.size(); ++i) {
    const std::string id = "a" + std::to_string(i);
    builder.add_agent(id, agents[i].start, agents[i].goal);
    for (Position cell : agents[i].tasks) {
      auto task = tasks.begin();
      while (task != tasks.end() && !(task->first == cell)) ++task;
      if (task == tasks.end()) task = tasks.insert(task, {cell, {}});
      task->second.push_back(id);
    }
  }
  for (std::size_t t = 0; t < tasks.size(); ++t)
    builder.add_task("t" + std::to_string(t), tasks[t].first, tasks[t].second);
  return std::move(builder).build();
}

}  // namespace grove::detail::testing
