// SPDX-License-Identifier: MIT
// Action dependency graph (ADG; Hoenig et al. 2019, Ma et al. 2017): the actions of a plan, with
// their dependencies and task visits. Robots that execute their actions in accordance with the
// dependencies never collide, whatever their delays.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/instance.h"
#include "model/plan.h"

namespace grove::detail {

using ActionIndex = std::int32_t;  // position in ActionDependencyGraph::actions()
inline constexpr ActionIndex kNoAction = -1;

// An action of a robot: a move of one step, a turn, or the execution of a task.
struct Action {
  enum class Kind : std::uint8_t { kMove, kTurn, kWork };
  Kind kind = Kind::kMove;
  AgentIndex agent = -1;
  State from = kNoState;  // base states (world.h)
  State to = kNoState;    // base state at completion; equal to `from` for kWork
  TaskIndex task = -1;    // for kWork only
  Time begin = 0;         // begin time in the plan, >= 0
  Time steps = 1;         // duration in the plan, from `begin`
};

// The moves, turns and task executions of a plan, without its waits, and the dependencies between
// these actions. An action may begin when
// - the previous action of the same robot is completed, and
// - the action after(), if any, is completed. For a move onto a place, this is the move with which
//   the robot that is on it before leaves it. A moving robot occupies both places until it has
//   arrived.
// The moves of robots that follow each other in a ring depend on each other in a cycle. Such moves
// are one joint step. They begin together, when all their dependencies outside the ring are
// fulfilled, and they are completed together. There are no other cycles; proof:
// action_dependency_graph.cpp. Immutable: any thread may read it.
class ActionDependencyGraph {
 public:
  // Throws std::invalid_argument if two robots of `plan` are on one place at the same time or swap
  // places, or if its number of agents differs from that of `instance`, and InstanceError if the
  // instance has choices, because the actions do not state visits without duration. Removes
  // transitive dependencies, which are dependencies on another robot's action that the remaining
  // ones imply. O(actions * (log actions + agents / 16)), plus the total length of the paths.
  ActionDependencyGraph(const Instance& instance, const Plan& plan);

  // All actions, ordered by agent, then by time. The actions of an agent are begin_of(agent), ...,
  // end_of(agent) - 1.
  std::span<const Action> actions() const { return actions_; }
  int agent_count() const { return static_cast<int>(first_.size()) - 1; }
  ActionIndex begin_of(AgentIndex agent) const { return first_[agent]; }
  ActionIndex end_of(AgentIndex agent) const { return first_[agent + 1]; }
  // The previous action of the same robot; kNoAction for its first action.
  ActionIndex before(ActionIndex action) const {
    return action == first_[actions_[action].agent] ? kNoAction : action - 1;
  }
  // The action of another robot that must be completed before `action` begins; kNoAction if there
  // is none, if the dependency is transitive, or if both actions belong to one ring.
  ActionIndex after(ActionIndex action) const { return after_[action]; }
  // Steps, in a topological order of the dependencies. A step is one action, or the moves of a
  // ring. In a ring each move enters the place that the next move leaves.
  std::int32_t step_count() const { return steps_.count(); }
  std::span<const ActionIndex> step(std::int32_t number) const { return steps_[number]; }
  // The number of dependencies between robots that were kept, the number that were removed as
  // transitive, and the number of rings.
  std::int64_t dependency_count() const { return dependency_count_; }
  std::int64_t removed_dependency_count() const { return removed_dependency_count_; }
  std::int64_t rings() const { return rings_; }

 private:
  void add_actions(const Instance& instance, AgentIndex agent, const AgentPlan& plan);
  void find_waits(const World& world, const Plan& plan);
  void order_steps();
  void remove_transitive();

  std::vector<Action> actions_;
  std::vector<ActionIndex> first_{0};  // by agent: its first action; then the end of the last agent
  std::vector<ActionIndex> after_;
  CsrArray steps_;
  std::int64_t dependency_count_ = 0;
  std::int64_t removed_dependency_count_ = 0;
  std::int64_t rings_ = 0;
};

// A visit to a task. It takes place when `action` is completed; kNoAction: at the start.
struct TaskVisit {
  TaskIndex task = -1;
  ActionIndex action = kNoAction;
};

// Returns, by agent, the visits to its tasks in order of time. A task without duration is visited
// when the agent is on its place for the first time, and a task with a duration when its execution
// is completed. Tasks that the actions do not visit are omitted.
std::vector<std::vector<TaskVisit>> task_visits(const Instance& instance,
                                                const ActionDependencyGraph& order);

}  // namespace grove::detail
