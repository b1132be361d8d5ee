// SPDX-License-Identifier: MIT
// Who must have left which place before whom: what of a plan robots have to keep to, however late
// they are (action dependency graph: Hoenig et al. 2019; Ma et al. 2017).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/plan.h"

namespace grove::detail {

using ActionIndex = std::int32_t;  // position in ActionDependencyGraph::actions()
inline constexpr ActionIndex kNoAction = -1;

// One thing that a robot does, begun and completed as a whole.
struct Action {
  enum class Kind : std::uint8_t { kMove, kTurn, kWork };
  Kind kind = Kind::kMove;
  AgentIndex agent = -1;
  State from = kNoState;  // base states (world.h)
  State to = kNoState;    // where it is when completed; at work the same
  TaskIndex task = -1;    // of work
  Time begin = 0;         // when it begins in the plan
  Time steps = 1;         // that it takes if nothing delays it
};

// The moves, turns and work of a plan without its waits, and what they wait for. An action begins
// when
//   - the robot's action before it is completed, and
//   - the action after() it names is: that of the robot that was on its place before, leaving. A
//     robot that moves holds both places until it has arrived.
// Robots that follow each other in a ring wait for each other all round: their moves are one joint
// step, begun together when each of them may begin but for that, and completed together. Why no
// others wait in a circle: passing_order.cpp. Immutable, so any number of threads may read one.
class ActionDependencyGraph {
 public:
  // Throws std::invalid_argument for what is no plan without collisions. Transitive waits are left
  // out: an action names another only if it could otherwise begin before that is completed.
  // O(actions * (log actions + agents / 16)).
  ActionDependencyGraph(const Instance& instance, const Plan& plan);

  // In order of agents, and for each in order of time.
  std::span<const Action> actions() const { return actions_; }
  int agent_count() const { return static_cast<int>(first_.size()) - 1; }
  ActionIndex begin_of(AgentIndex agent) const { return first_[agent]; }
  ActionIndex end_of(AgentIndex agent) const { return first_[agent + 1]; }
  // The action of the same robot before this one; none if it is the first.
  ActionIndex before(ActionIndex action) const {
    return action == first_[actions_[action].agent] ? kNoAction : action - 1;
  }
  // The action of another robot that must be completed first; none if that follows anyway.
  ActionIndex after(ActionIndex action) const { return after_[action]; }
  // Steps: an action, or the moves of a ring in order, each into the place that the one before it
  // leaves; in an order in which they may be taken one after the other.
  std::int32_t step_count() const { return steps_.count(); }
  std::span<const ActionIndex> step(std::int32_t number) const { return steps_[number]; }
  // Waits between robots that are left, those that were left out, and joint steps.
  std::int64_t waits() const { return waits_; }
  std::int64_t transitive_waits() const { return transitive_waits_; }
  std::int64_t rings() const { return rings_; }

 private:
  void add_actions(const Instance& instance, AgentIndex agent, const AgentPlan& plan);
  void find_waits(const World& world, const Plan& plan);
  void order_steps();
  void leave_out_transitive();

  std::vector<Action> actions_;
  std::vector<ActionIndex> first_{0};  // by agent; one more at the end
  std::vector<ActionIndex> after_;
  CsrArray steps_;
  std::int64_t waits_ = 0;
  std::int64_t transitive_waits_ = 0;
  std::int64_t rings_ = 0;
};

}  // namespace grove::detail
