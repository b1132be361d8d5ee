// SPDX-License-Identifier: MIT
// Action dependency graph (ADG; Hoenig et al. 2019, Ma et al. 2017): the actions of a plan, which
// of them must be completed before which, and the tasks that they visit. Robots that keep to it
// never collide, whatever their delays.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/instance.h"
#include "model/plan.h"

namespace grove::detail {

using ActionIndex = std::int32_t;  // position in ActionDependencyGraph::actions()
inline constexpr ActionIndex kNoAction = -1;

// An action of a robot: it begins and is completed as a whole.
struct Action {
  enum class Kind : std::uint8_t { kMove, kTurn, kWork };
  Kind kind = Kind::kMove;
  AgentIndex agent = -1;
  State from = kNoState;  // base states (world.h)
  State to = kNoState;    // base state at completion; for work equal to `from`
  TaskIndex task = -1;    // for work only
  Time begin = 0;         // begin in the plan
  Time steps = 1;         // duration without delays
};

// The moves, turns and work of a plan without its waits, and the dependencies between them. An
// action may begin when
// - the previous action of the same robot is completed, and
// - the action after() is completed. This is the move with which the previous robot on the place
//   that the action enters leaves this place. A robot that moves occupies both places until it has
//   arrived.
// The moves of robots that follow each other in a ring depend on each other in a cycle. They are
// one joint step: they begin together, when each of them may begin except for this cycle, and they
// are completed together. There are no other cycles; the proof is in action_dependency_graph.cpp.
// Immutable: any thread may read it.
class ActionDependencyGraph {
 public:
  // Throws std::invalid_argument if `plan` is not a plan without collisions. Transitive
  // dependencies are removed: an action depends on another robot's action only if it could
  // otherwise begin before that one is completed. O(actions * (log actions + agents / 16)).
  ActionDependencyGraph(const Instance& instance, const Plan& plan);

  // Ordered by agent, then by time.
  std::span<const Action> actions() const { return actions_; }
  int agent_count() const { return static_cast<int>(first_.size()) - 1; }
  ActionIndex begin_of(AgentIndex agent) const { return first_[agent]; }
  ActionIndex end_of(AgentIndex agent) const { return first_[agent + 1]; }
  // The previous action of the same robot; kNoAction for its first action.
  ActionIndex before(ActionIndex action) const {
    return action == first_[actions_[action].agent] ? kNoAction : action - 1;
  }
  // The action of another robot that must be completed first; kNoAction if there is none, or if the
  // dependency is transitive.
  ActionIndex after(ActionIndex action) const { return after_[action]; }
  // Steps, in a topological order. A step is one action, or the moves of a ring, in which each move
  // enters the place that the next one leaves.
  std::int32_t step_count() const { return steps_.count(); }
  std::span<const ActionIndex> step(std::int32_t number) const { return steps_[number]; }
  // The number of dependencies between robots that remain, the number that were removed as
  // transitive, and the number of joint steps.
  std::int64_t waits() const { return waits_; }
  std::int64_t transitive_waits() const { return transitive_waits_; }
  std::int64_t rings() const { return rings_; }

 private:
  void add_actions(const Instance& instance, AgentIndex agent, const AgentPlan& plan);
  void find_waits(const World& world, const Plan& plan);
  void order_steps();
  void remove_transitive();

  std::vector<Action> actions_;
  std::vector<ActionIndex> first_{0};  // by agent, and the end of the last one
  std::vector<ActionIndex> after_;
  CsrArray steps_;
  std::int64_t waits_ = 0;
  std::int64_t transitive_waits_ = 0;
  std::int64_t rings_ = 0;
};

// The visit is made when `action` is completed; kNoAction: at the start.
struct TaskVisit {
  TaskIndex task = -1;
  ActionIndex action = kNoAction;
};

// Returns the visits by agent, in the order of its actions. A task without duration is visited when
// the agent first is on its place; other tasks when their work is done. Tasks that `order` does not
// visit are omitted.
std::vector<std::vector<TaskVisit>> task_visits(const Instance& instance,
                                                const ActionDependencyGraph& order);

}  // namespace grove::detail
