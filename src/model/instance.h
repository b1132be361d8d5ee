// SPDX-License-Identifier: MIT
// A CTS-MAPF instance: a map, agents, and the tasks that each agent must visit (docs/design.md,
// section 1).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <set>
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

// The maximum number of tasks that an agent must visit. Sets of these are 64-bit masks.
inline constexpr int kMaxTasksPerAgent = 64;

// An agent has at most one of `goal` and `goals`. Each vector of tasks is in ascending order.
struct Agent {
  std::string id;
  State start = kNoState;
  std::optional<Place> goal;            // the destination; nullopt: none or a choice
  std::vector<Place> goals = {};        // the places of which it chooses its destination
  std::optional<Heading> goal_heading;  // the heading at rest; nullopt: any heading
  Motion motion = {};
  int kind = 0;                         // kind of the agent's base states (world.h)
  std::vector<TaskIndex> tasks = {};    // tasks that it must visit
  std::vector<TaskIndex> options = {};  // further tasks that it may visit
  // The tasks that the search must order, a subsequence of `tasks`. Of the agent's tasks on one
  // place, the stops are those that take time or, if none does, one of them. When an agent
  // visits its stops on a place, it also visits its other tasks there. (Exception:
  // InstanceBuilder::may_leave_out_stops().)
  std::vector<TaskIndex> stops = {};

  bool has_destination() const { return goal || !goals.empty(); }
  // The places of which it may have one as its destination; empty: it has none.
  std::vector<Place> destinations() const;
  // True for an agent with neither a destination nor tasks that it must visit. It may rest
  // anywhere.
  bool is_idle() const { return !has_destination() && tasks.empty(); }
  // True if the agent may choose its destination, or whether to visit a task.
  bool has_choice() const { return !goals.empty() || !options.empty(); }
};

struct Task {
  std::string id;
  Place cell = kNoPlace;
  std::vector<AgentIndex> agents;  // the agents that must or may visit the task
  Time duration = 0;               // of its execution, in steps
  int need = 0;                    // at least this many of `agents` must visit it; 1 or more

  // True if each of `agents` must visit the task.
  bool needs_all() const { return need == static_cast<int>(agents.size()); }
  // True if a plan states each visit explicitly (AgentPlan::work). Otherwise an agent visits the
  // task by being on its place.
  bool has_stated_visits() const { return duration > 0 || !needs_all(); }
};

// Execution of a task that an agent began before time 0: the task's id, and the number of steps
// done.
struct WorkBegun {
  std::string task;
  Time done = 0;
};

// Description of an agent for InstanceBuilder::add_agent(). If the agent turns freely, only the
// place of `start` is used. `goal_heading` requires `goal` or `goals`, and an agent whose turns
// take time.
struct AgentSpec {
  std::string id;
  Pose start;
  std::optional<Place> goal;
  Motion motion = {};
  std::optional<Heading> goal_heading = {};
  std::optional<WorkBegun> working = {};
  std::vector<Place> goals = {};  // requires that `goal` is nullopt
};

// Thrown for an instance that violates a rule of docs/design.md, section 1. field() names the
// invalid part of the agent or task that is being added, for example "start", "cell" or "agents/2",
// or of the instance that is being built. what() describes the error.
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
  // The map, for building further instances on it. Instances that share the map can share all data
  // that depends only on the map.
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
  // The ids of all agents, by AgentIndex.
  std::vector<std::string> agent_ids() const;
  // True if an agent may choose its destination, or whether to visit a task.
  bool has_choices() const;
  // True (the default) if an agent may enter a place in the step in which another agent leaves it.
  bool may_follow() const { return may_follow_; }
  // A copy of this instance in which following is forbidden, for robots that occupy a place until
  // they have left it completely ("1-robust plans", Atzmon et al. 2020).
  Instance without_following() const {
    Instance instance = *this;
    instance.may_follow_ = false;
    return instance;
  }
  // The specification from which InstanceBuilder::add_agent() creates this agent.
  AgentSpec spec(AgentIndex agent) const;

  // Conversions between poses and base states of the agent's kind. For a state at work, pose_of()
  // returns the pose in which the agent works.
  State state_of(AgentIndex agent, const Pose& pose) const {
    return motion_world_ ? motion_world_->state(agents_[agent].kind, pose) : pose.place;
  }
  Pose pose_of(State state) const {
    const State base = world_->base(state);
    return world_->kind(base) == 0 ? Pose{.place = base} : motion_world_->pose(base);
  }

  // True if an agent in `state` visits the task. A task that takes time is visited in the last
  // state of its execution.
  bool is_visited(TaskIndex task, State state) const {
    const Task& t = tasks_[task];
    if (t.duration == 0) return world_->place(state) == t.cell;
    if (!world_->is_working(state)) return false;
    const Work& work = world_->work(state);
    return work.task == task && work.completed;
  }
  // True if the agent may rest in `state` once it has visited all tasks that it must visit. Two
  // rules for agents with optional tasks are not part of it, because they depend on more than the
  // state: without a destination, an agent that must visit a task may also rest on an optional one
  // that it has visited, and one that must visit none may not rest within a turn.
  bool may_rest(AgentIndex agent, State state) const;
  // states_visiting(): all states in which is_visited() is true. states_to_rest(): all states in
  // which may_rest() is true; empty for an idle agent, which may rest in any state.
  std::vector<State> states_visiting(TaskIndex task) const;
  std::vector<State> states_to_rest(AgentIndex agent) const;
  // True if the agent rests on the last stop of its sequence: if it has tasks but no destination,
  // and none of its tasks takes time, so that it can visit a task once more at the end.
  bool rests_on_last_stop(AgentIndex agent) const;
  // All tasks that the agent must visit, in the order in which it visits them if it visits its
  // stops in the order `stops` (positions in Agent::stops).
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

// Builds an Instance: add all agents, then all tasks, then call build(). Each rule is checked as
// soon as it can be. Except for copies, instances are created in no other way. One thread at a
// time.
class InstanceBuilder {
 public:
  explicit InstanceBuilder(Map map);
  explicit InstanceBuilder(std::shared_ptr<const Map> map);
  // Returns a builder with the map and the rules of `instance`, without agents and tasks.
  static InstanceBuilder like(const Instance& instance);
  const Map& map() const { return instance_.map(); }
  const Roadmap* roadmap() const { return instance_.roadmap(); }
  // The ids of the agents added so far, in order.
  std::vector<std::string> agent_ids() const { return instance_.agent_ids(); }

  void forbid_following() { instance_.may_follow_ = false; }

  // Adds an agent on a grid. Throws InstanceError for an empty or repeated id, and for a start or
  // goal that is outside the grid or blocked, or that another agent has as its start or goal,
  // respectively; also for a repeated place in `goals`. Different agents may have the same place
  // in their `goals`.
  AgentIndex add_agent(std::string id, Position start, std::optional<Position> goal);
  // Adds an agent on any map, with the same checks. Precondition on a roadmap: the places exist.
  AgentIndex add_agent(std::string id, Place start, std::optional<Place> goal);
  AgentIndex add_agent(AgentSpec spec);

  // Adds a task on a grid. Throws InstanceError for: an empty or repeated id; a cell that is
  // outside the grid or blocked; an empty list of agents, an unknown or repeated agent, or an agent
  // that must already visit kMaxTasksPerAgent tasks; a duration that is not in 0, ...,
  // kMaxDuration; a need that is not in 1, ..., the number of agents. Without `need`, all agents
  // must visit the task.
  TaskIndex add_task(std::string id, Position cell, std::span<const std::string> agent_ids,
                     Time duration = 0, std::optional<int> need = {});
  // Adds a task on any map, with the same checks. Precondition on a roadmap: the place exists.
  TaskIndex add_task(std::string id, Place place, std::span<const std::string> agent_ids,
                     Time duration = 0, std::optional<int> need = {});

  // For a search in which the agent may leave out stops: one of its tasks without a duration on
  // each place is a stop, also if others there take time.
  void may_leave_out_stops(AgentIndex agent) { leaves_out_stops_.insert(agent); }

  // The maximum duration of a task or a quarter turn, in steps.
  static constexpr Time kMaxDuration = 1 << 16;

  // Returns the instance. Throws InstanceError with field "agents" if there are no agents;
  // "agents/<i>/working/..." if an agent is at work on a task that does not exist, is not its own,
  // is not on its start, takes no time, or is already complete; "map" or "roadmap" if there are too
  // many states, or agents whose turns take time on a roadmap.
  Instance build() &&;

 private:
  Cell passable_cell(const std::string& field, Position p) const;
  std::string name(Place place) const;
  void require_choice_of_goals(const AgentSpec& spec) const;
  void choose_stops(AgentIndex agent);
  void require_work(AgentIndex agent, const WorkBegun& begun) const;
  void make_world();
  std::vector<MotionWorld::Job> jobs() const;

  Instance instance_;
  std::vector<AgentSpec> specs_;  // by AgentIndex
  std::vector<Motion> motions_;   // distinct motions with turn_steps > 0
  std::set<AgentIndex> leaves_out_stops_;
  std::unordered_map<std::string, AgentIndex> agent_by_id_;
  std::unordered_map<std::string, TaskIndex> task_by_id_;
  std::unordered_map<Place, AgentIndex> agent_by_start_;
  std::unordered_map<Place, AgentIndex> agent_by_goal_;
};

}  // namespace grove::detail
