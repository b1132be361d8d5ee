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
#include <vector>

#include "model/map.h"
#include "model/motion_world.h"

namespace grove::detail {

using AgentIndex = std::int32_t;  // position in Instance::agents()

// An agent may have at most this many tasks: sets of them are 64-bit masks throughout.
inline constexpr int kMaxTasksPerAgent = 64;

struct Agent {
  std::string id;
  State start = kNoState;
  std::optional<Place> goal;            // its destination; none for an MG-MAPF agent
  std::optional<Heading> goal_heading;  // in which it must rest; none: no matter
  Motion motion = {};
  int kind = 0;                       // of its states (world.h)
  std::vector<TaskIndex> tasks = {};  // in the order in which the instance lists them
  // What the search visits: of the tasks on one place those that take time, or else one; for on the
  // way all others there are visited, too. In the order of the tasks.
  std::vector<TaskIndex> stops = {};

  // With nothing to do, it may come to rest anywhere.
  bool is_idle() const { return !goal && tasks.empty(); }
};

struct Task {
  std::string id;
  Place cell = kNoPlace;
  std::vector<AgentIndex> agents;  // each of them must visit the place
  Time duration = 0;               // and be at work there for so many steps
};

// Work on a task, by its id, that an agent has begun before it starts.
struct WorkBegun {
  std::string task;
  Time done = 0;
};

// What is to be known of an agent that does more than go freely from place to place. The pose of an
// agent that turns freely is its place.
struct AgentSpec {
  std::string id;
  Pose start;
  std::optional<Place> goal;
  Motion motion = {};
  std::optional<Heading> goal_heading = {};
  std::optional<WorkBegun> working = {};
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

// A valid instance. Immutable once built, so any number of threads may read one. Copies share the
// map.
class Instance {
 public:
  const World& world() const { return *world_; }
  const Map& map() const { return *map_; }
  // To build others on: what was computed for one map holds for all of its instances.
  std::shared_ptr<const Map> shared_map() const { return map_; }
  // Null if every state is its place.
  const MotionWorld* motion_world() const { return motion_world_.get(); }
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
  // May an agent enter a place in the step in which another leaves it? As a rule it may.
  bool may_follow() const { return may_follow_; }
  // The same instance where it may not, as robots that hold a place until they have left it would
  // have it ("1-robust plans", Atzmon et al. 2020).
  Instance without_following() const {
    Instance instance = *this;
    instance.may_follow_ = false;
    return instance;
  }
  // What an InstanceBuilder would be told to add this agent.
  AgentSpec spec(AgentIndex agent) const;

  // The base state of this agent's kind, and back (of the state in which it works, if it does).
  State state_of(AgentIndex agent, const Pose& pose) const {
    return motion_world_ ? motion_world_->state(agents_[agent].kind, pose) : pose.place;
  }
  Pose pose_of(State state) const {
    const State base = world_->base(state);
    return world_->kind(base) == 0 ? Pose{.place = base} : motion_world_->pose(base);
  }

  // Is the task visited by an agent in this state (at work: when it is completed)?
  bool is_visited(TaskIndex task, State state) const {
    const Task& t = tasks_[task];
    if (t.duration == 0) return world_->place(state) == t.cell;
    if (!world_->is_working(state)) return false;
    const Work& work = world_->work(state);
    return work.task == task && work.completed;
  }
  // May the agent come to rest in this state, if nothing is left to do?
  bool may_rest(AgentIndex agent, State state) const;
  // All states in which that is so; empty: in any.
  std::vector<State> states_visiting(TaskIndex task) const;
  std::vector<State> states_to_rest(AgentIndex agent) const;
  // Does it rest on the last one of its sequence? (So it is of agents without a destination whose
  // tasks take no time: they can be visited again at the end.)
  bool rests_on_last_stop(AgentIndex agent) const;
  // What the agent does, in an order of its stops given by their positions.
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

// Collects agents, then tasks, and checks every rule as they come. The only way to make an
// Instance.
class InstanceBuilder {
 public:
  explicit InstanceBuilder(Map map);
  explicit InstanceBuilder(std::shared_ptr<const Map> map);
  // With the map and the rules of another instance.
  static InstanceBuilder like(const Instance& instance);
  const Map& map() const { return instance_.map(); }
  const Roadmap* roadmap() const { return instance_.roadmap(); }

  void forbid_following() { instance_.may_follow_ = false; }

  // On a grid. Throws InstanceError: empty or repeated id; start or goal outside, blocked or taken.
  AgentIndex add_agent(std::string id, Position start, std::optional<Position> goal);
  // The same on any map, by state and place of its world.
  AgentIndex add_agent(std::string id, Place start, std::optional<Place> goal);
  AgentIndex add_agent(AgentSpec spec);

  // On a grid. Throws InstanceError: empty or repeated id; cell outside or blocked; no agent, an
  // unknown or a repeated one, or one with more than kMaxTasksPerAgent tasks; a duration out of
  // range.
  TaskIndex add_task(std::string id, Position cell, std::span<const std::string> agent_ids,
                     Time duration = 0);
  // The same on any map.
  TaskIndex add_task(std::string id, Place place, std::span<const std::string> agent_ids,
                     Time duration = 0);

  // The longest work or quarter turn.
  static constexpr Time kLongest = 1 << 16;

  // Throws InstanceError (field "agents" or "agents/<i>/working/..."): no agents at all, or one at
  // work on what is not its own, not where it starts, or done; ("map") too many states.
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
  std::vector<Motion> motions_;   // with turns, distinct
  std::unordered_map<std::string, AgentIndex> agent_by_id_;
  std::unordered_map<std::string, TaskIndex> task_by_id_;
  std::unordered_map<Place, AgentIndex> agent_by_start_;
  std::unordered_map<Place, AgentIndex> agent_by_goal_;
};

}  // namespace grove::detail
