// SPDX-License-Identifier: MIT
// A CTS-MAPF instance: a map, agents, and the places that each agent must visit (docs/design.md,
// section 1).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "model/map.h"
#include "model/motion_world.h"

namespace grove::detail {

using AgentIndex = std::int32_t;  // position in Instance::agents()

// The maximum number of tasks of an agent, because sets of its tasks are 64-bit masks.
inline constexpr int kMaxTasksPerAgent = 64;

struct Agent {
  std::string id;
  State start = kNoState;
  std::optional<Place> goal;            // its destination; nullopt for an MG-MAPF agent
  std::optional<Heading> goal_heading;  // the heading at rest; nullopt: any heading
  Motion motion = {};
  int kind = 0;                       // the kind of its states (world.h)
  std::vector<TaskIndex> tasks = {};  // in the order in which the instance lists them
  // The tasks that the search visits, in the order of `tasks`. Of the tasks on one place, these are
  // the ones that take time, or one task if none does. An agent that visits these also visits all
  // other tasks on that place.
  std::vector<TaskIndex> stops = {};

  // True for an agent without goal and tasks, which may rest anywhere.
  bool is_idle() const { return !goal && tasks.empty(); }
};

struct Task {
  std::string id;
  Place cell = kNoPlace;
  std::vector<AgentIndex> agents;  // each of them must visit the place
  Time duration = 0;               // steps of work there
};

// Work on a task, given by its id, that an agent has begun before time 0.
struct WorkBegun {
  std::string task;
  Time done = 0;
};

// Description of an agent, including turns and work. If the agent turns freely, only the place of
// `start` counts.
struct AgentSpec {
  std::string id;
  Pose start;
  std::optional<Place> goal;
  Motion motion = {};
  std::optional<Heading> goal_heading = {};
  std::optional<WorkBegun> working = {};
};

// A violated rule of docs/design.md, section 1. `field` names the invalid part of the agent or task
// being added ("id", "start", "goal", "tasks", "cell", "agents", "agents/2"). what() describes the
// error.
class InstanceError : public std::invalid_argument {
 public:
  InstanceError(std::string field, const std::string& message)
      : std::invalid_argument(message), field_(std::move(field)) {}
  const std::string& field() const { return field_; }

 private:
  std::string field_;
};

// A valid instance. Immutable: any thread may read it. Copies share the map.
class Instance {
 public:
  const World& world() const { return *world_; }
  const Map& map() const { return *map_; }
  // The map, to build other instances with. Data that depends only on the map is valid for all of
  // them.
  std::shared_ptr<const Map> shared_map() const { return map_; }
  // Returns nullptr if every state is equal to its place.
  const MotionWorld* motion_world() const { return motion_world_.get(); }
  // Returns nullptr if the map is a grid.
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
  // True, as by default, if an agent may enter a place in the step in which another one leaves it.
  bool may_follow() const { return may_follow_; }
  // The same instance without following, for robots that hold a place until they have left it
  // ("1-robust plans", Atzmon et al. 2020).
  Instance without_following() const {
    Instance instance = *this;
    instance.may_follow_ = false;
    return instance;
  }
  // The specification with which InstanceBuilder::add_agent() would add this agent.
  AgentSpec spec(AgentIndex agent) const;

  // Converts between poses and base states of the agent's kind. pose_of() of a state of work is the
  // pose in which the agent works.
  State state_of(AgentIndex agent, const Pose& pose) const {
    return motion_world_ ? motion_world_->state(agents_[agent].kind, pose) : pose.place;
  }
  Pose pose_of(State state) const {
    const State base = world_->base(state);
    return world_->kind(base) == 0 ? Pose{.place = base} : motion_world_->pose(base);
  }

  // True if an agent in `state` visits the task. A task that takes time is visited when its work is
  // completed.
  bool is_visited(TaskIndex task, State state) const {
    const Task& t = tasks_[task];
    if (t.duration == 0) return world_->place(state) == t.cell;
    if (!world_->is_working(state)) return false;
    const Work& work = world_->work(state);
    return work.task == task && work.completed;
  }
  // True if the agent may rest in `state`, provided that no task is left.
  bool may_rest(AgentIndex agent, State state) const;
  // All states in which is_visited() or may_rest() is true. states_to_rest() is empty for an idle
  // agent, which may rest in any state.
  std::vector<State> states_visiting(TaskIndex task) const;
  std::vector<State> states_to_rest(AgentIndex agent) const;
  // True if the agent rests on the last stop of its sequence. This holds for agents without a
  // destination whose tasks take no time, because such a task can be visited again at the end.
  bool rests_on_last_stop(AgentIndex agent) const;
  // The agent's tasks in the order in which they are visited. `stops`: an order of its stops, as
  // positions in Agent::stops.
  std::vector<TaskIndex> tasks_in_order(AgentIndex agent,
                                        std::span<const std::uint8_t> stops) const;

 private:
  friend class InstanceBuilder;
  explicit Instance(std::shared_ptr<const Map> map);

  std::shared_ptr<const Map> map_;
  std::shared_ptr<const MotionWorld> motion_world_;
  const World* world_;  // the map itself, or motion_world_
  std::vector<Agent> agents_;
  std::vector<Task> tasks_;
  bool may_follow_ = true;
};

// Builds instances: collects agents, then tasks, and checks every rule when they are added. There
// is no other way to make an Instance.
class InstanceBuilder {
 public:
  explicit InstanceBuilder(Map map);
  explicit InstanceBuilder(std::shared_ptr<const Map> map);
  // Begins with the map and the rules of `instance`.
  static InstanceBuilder like(const Instance& instance);
  const Map& map() const { return instance_.map(); }
  const Roadmap* roadmap() const { return instance_.roadmap(); }

  void forbid_following() { instance_.may_follow_ = false; }

  // Adds an agent on a grid. Throws InstanceError for an empty or repeated id, and for a start or
  // goal that is outside, blocked or taken.
  AgentIndex add_agent(std::string id, Position start, std::optional<Position> goal);
  // The same on any map; `start` and `goal` are places.
  AgentIndex add_agent(std::string id, Place start, std::optional<Place> goal);
  AgentIndex add_agent(AgentSpec spec);

  // Adds a task on a grid. Throws InstanceError for: an empty or repeated id; a cell that is
  // outside or blocked; no agent, an unknown or repeated agent, or one with more than
  // kMaxTasksPerAgent tasks; a duration out of range.
  TaskIndex add_task(std::string id, Position cell, std::span<const std::string> agent_ids,
                     Time duration = 0);
  // The same on any map.
  TaskIndex add_task(std::string id, Place place, std::span<const std::string> agent_ids,
                     Time duration = 0);

  // The maximum duration of a task or a quarter turn, in steps.
  static constexpr Time kMaxDuration = 1 << 16;

  // Throws InstanceError. Field "agents" or "agents/<i>/working/...": there are no agents, or an
  // agent is at work on a task that is not its own, is not on its start, or is complete. Field
  // "map" or "roadmap": too many states.
  Instance build() &&;

 private:
  Cell passable_cell(const std::string& field, Position p) const;
  std::string name(Place place) const;
  void choose_stops(Agent& agent) const;
  void require_work(AgentIndex agent, const WorkBegun& begun) const;
  void make_world();
  std::vector<MotionWorld::Job> jobs() const;

  Instance instance_;
  std::vector<AgentSpec> specs_;  // by AgentIndex
  std::vector<Motion> motions_;   // distinct motions with turns
  std::unordered_map<std::string, AgentIndex> agent_by_id_;
  std::unordered_map<std::string, TaskIndex> task_by_id_;
  std::unordered_map<Place, AgentIndex> agent_by_start_;
  std::unordered_map<Place, AgentIndex> agent_by_goal_;
};

}  // namespace grove::detail
