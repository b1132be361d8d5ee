// SPDX-License-Identifier: MIT
// A CTS-MAPF instance: a grid, agents, and the cells each must visit (docs/design.md, section 1).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <vector>

#include "grove/model/grid.h"

namespace grove {

using AgentIndex = std::int32_t;  // position in Instance::agents()
using TaskIndex = std::int32_t;   // position in Instance::tasks()

// An agent may have at most this many tasks: sets of them are 64-bit masks throughout.
inline constexpr int kMaxTasksPerAgent = 64;

struct Agent {
  std::string id;
  Cell start = kNoCell;
  std::optional<Cell> goal;      // its destination; none for an MG-MAPF agent
  std::vector<TaskIndex> tasks;  // in the order in which the instance lists them
};

struct Task {
  std::string id;
  Cell cell = kNoCell;
  std::vector<AgentIndex> agents;  // each of them must visit the cell
};

// One broken rule of section 1. `field` names the offending part of the agent or task being added
// ("id", "start", "goal", "tasks", "cell", "agents", "agents/2"); what() says what is wrong.
class InstanceError : public std::invalid_argument {
 public:
  InstanceError(std::string field, const std::string& message)
      : std::invalid_argument(message), field_(std::move(field)) {}
  const std::string& field() const { return field_; }

 private:
  std::string field_;
};

// A valid instance. Immutable once built, so any number of threads may read one.
class Instance {
 public:
  const World& world() const { return grid_; }
  const Grid& grid() const { return grid_; }
  std::span<const Agent> agents() const { return agents_; }
  std::span<const Task> tasks() const { return tasks_; }
  const Agent& agent(AgentIndex i) const { return agents_[i]; }
  const Task& task(TaskIndex i) const { return tasks_[i]; }
  int agent_count() const { return static_cast<int>(agents_.size()); }
  int task_count() const { return static_cast<int>(tasks_.size()); }

 private:
  friend class InstanceBuilder;
  explicit Instance(Grid grid) : grid_(std::move(grid)) {}

  Grid grid_;
  std::vector<Agent> agents_;
  std::vector<Task> tasks_;
};

// Collects agents, then tasks, and checks every rule as they come. The only way to make an
// Instance.
class InstanceBuilder {
 public:
  explicit InstanceBuilder(Grid grid);

  // Throws InstanceError: empty or repeated id; start or goal outside, blocked or taken.
  AgentIndex add_agent(std::string id, Position start, std::optional<Position> goal);

  // Throws InstanceError: empty or repeated id; cell outside, blocked or already a task's; no
  // agent, an unknown or a repeated one, or one with more than kMaxTasksPerAgent tasks.
  TaskIndex add_task(std::string id, Position cell, std::span<const std::string> agent_ids);

  // Throws InstanceError (field "agents" or "agents/<i>"): no agents at all, or an agent with
  // neither a destination nor a task.
  Instance build() &&;

 private:
  Cell passable_cell(const std::string& field, Position p) const;

  Instance instance_;
  std::unordered_map<std::string, AgentIndex> agent_by_id_;
  std::unordered_map<std::string, TaskIndex> task_by_id_;
  std::unordered_map<Cell, AgentIndex> agent_by_start_;
  std::unordered_map<Cell, AgentIndex> agent_by_goal_;
  std::unordered_map<Cell, TaskIndex> task_by_cell_;
};

}  // namespace grove
