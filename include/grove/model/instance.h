// SPDX-License-Identifier: MIT
// A CTS-MAPF instance: a map, agents, and the places each must visit (docs/design.md, section 1).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <utility>
#include <variant>
#include <vector>

#include "grove/model/grid.h"
#include "grove/model/roadmap.h"

namespace grove {

using AgentIndex = std::int32_t;  // position in Instance::agents()
using TaskIndex = std::int32_t;   // position in Instance::tasks()

// An agent may have at most this many tasks: sets of them are 64-bit masks throughout.
inline constexpr int kMaxTasksPerAgent = 64;

struct Agent {
  std::string id;
  State start = kNoState;
  std::optional<Place> goal;     // its destination; none for an MG-MAPF agent
  std::vector<TaskIndex> tasks;  // in the order in which the instance lists them
};

struct Task {
  std::string id;
  Place cell = kNoPlace;
  std::vector<AgentIndex> agents;  // each of them must visit the place
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

// What agents move on.
using Map = std::variant<Grid, Roadmap>;

// A valid instance. Immutable once built, so any number of threads may read one. Copies share the
// map.
class Instance {
 public:
  const World& world() const { return *world_; }
  const Map& map() const { return *map_; }
  // Null if the map is a grid.
  const Roadmap* roadmap() const { return std::get_if<Roadmap>(map_.get()); }
  bool is_on_grid() const { return std::holds_alternative<Grid>(*map_); }
  // Throws std::bad_variant_access if the map is a roadmap.
  const Grid& grid() const { return std::get<Grid>(*map_); }
  std::span<const Agent> agents() const { return agents_; }
  std::span<const Task> tasks() const { return tasks_; }
  const Agent& agent(AgentIndex i) const { return agents_[i]; }
  const Task& task(TaskIndex i) const { return tasks_[i]; }
  int agent_count() const { return static_cast<int>(agents_.size()); }
  int task_count() const { return static_cast<int>(tasks_.size()); }

 private:
  friend class InstanceBuilder;
  explicit Instance(Map map);

  std::shared_ptr<const Map> map_;
  const World* world_;  // the map itself
  std::vector<Agent> agents_;
  std::vector<Task> tasks_;
};

// Collects agents, then tasks, and checks every rule as they come. The only way to make an
// Instance.
class InstanceBuilder {
 public:
  explicit InstanceBuilder(Map map);
  const Roadmap* roadmap() const { return instance_.roadmap(); }

  // On a grid. Throws InstanceError: empty or repeated id; start or goal outside, blocked or taken.
  AgentIndex add_agent(std::string id, Position start, std::optional<Position> goal);
  // The same on any map, by state and place of its world.
  AgentIndex add_agent(std::string id, State start, std::optional<Place> goal);

  // On a grid. Throws InstanceError: empty or repeated id; cell outside, blocked or already a
  // task's; no agent, an unknown or a repeated one, or one with more than kMaxTasksPerAgent tasks.
  TaskIndex add_task(std::string id, Position cell, std::span<const std::string> agent_ids);
  // The same on any map.
  TaskIndex add_task(std::string id, Place place, std::span<const std::string> agent_ids);

  // Throws InstanceError (field "agents" or "agents/<i>"): no agents at all, or an agent with
  // neither a destination nor a task.
  Instance build() &&;

 private:
  Cell passable_cell(const std::string& field, Position p) const;
  std::string name(Place place) const;

  Instance instance_;
  std::unordered_map<std::string, AgentIndex> agent_by_id_;
  std::unordered_map<std::string, TaskIndex> task_by_id_;
  std::unordered_map<Place, AgentIndex> agent_by_start_;
  std::unordered_map<Place, AgentIndex> agent_by_goal_;
  std::unordered_map<Place, TaskIndex> task_by_place_;
};

}  // namespace grove
