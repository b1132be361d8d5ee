// SPDX-License-Identifier: MIT
/// \file
/// Re-planning: sessions, which keep an instance and its plan up to date during execution.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "grove/export.hpp"
#include "grove/solve.hpp"

namespace grove {

/// Delay of an agent: it is where the plan had it `steps` time steps earlier.
struct Delay {
  std::string agent = {};  ///< Id of the agent.
  int steps = 0;           ///< Time steps, >= 0.
};

/// \deprecated Old name of Delay; will be removed in 0.2.
using Late [[deprecated("use grove::Delay")]] = Delay;

/// Changes to an instance during execution.
struct Change {
  std::vector<Task> new_tasks = {};             ///< New tasks, of existing agents.
  std::vector<std::string> dropped_tasks = {};  ///< Ids of unvisited tasks to remove.
  std::vector<Place> blocked = {};  ///< Cells to block, or vertices with all their roads.
};

/// A re-planning session. Keeps the world, its distances and the plan between runs, so that
/// replan() can reuse them. Owns its data. A moved-from session may only be assigned to or
/// destroyed. One thread at a time.
class GROVE_API Session {
 public:
  /// Creates a session without a plan.
  explicit Session(Instance instance);
  /// Creates a session with a plan of the instance. Throws InvalidArgument with field() "/plan/..."
  /// if the plan is not valid.
  Session(Instance instance, const Plan& plan);
  ~Session();
  Session(Session&&) noexcept;             ///< Move constructor.
  Session& operator=(Session&&) noexcept;  ///< Move assignment.

  /// Returns the remaining instance, in which the current time is 0. An agent without a destination
  /// that has visited all its tasks is idle. An agent without a destination that has tasks left,
  /// but whose plan ends on a visited task, has that place as its destination until the next
  /// replan(), or until a change() that affects it. A task with Task::need below the number of its
  /// agents loses the agents that have visited it, and needs as many visits less; when it needs
  /// none, it is removed.
  Instance instance() const;
  /// Returns a valid plan of instance(). Returns std::nullopt if the session has had no plan yet,
  /// or if change() has reset it, until replan() finds a plan.
  std::optional<Plan> plan() const;

  /// Advances the session by `steps` >= 0 time steps along its plan. At the end of these steps each
  /// agent in `late` is Delay::steps time steps behind the plan, and its delay propagates to the
  /// agents that must wait for it. After the end of the plan all agents rest. Replaces instance()
  /// and plan() by what remains of them, with time counted from 0.
  ///
  /// Throws InvalidArgument and then leaves the session unchanged. field() is "" if there is no
  /// plan, "/steps" if steps < 0, "/late/<i>" for an unknown agent or a negative delay, and "/late"
  /// for a delay above `steps`, an agent that is listed twice, or a delay that is impossible
  /// because of another agent.
  void advance(int steps, const std::vector<Delay>& late = {});

  /// Changes the instance. plan() is std::nullopt afterwards if the old plan is no longer valid or
  /// a task was dropped; the next replan() repairs the plan. Throws InvalidArgument and leaves the
  /// session unchanged if the change is impossible: an agent is on a place to block or must go
  /// there, the place is blocked already, or an id is taken or unknown. field() is
  /// "/new_tasks/<i>/...", "/dropped_tasks/<i>" or "/blocked/<i>".
  void change(const Change& change);

  /// Returns the default options of replan() and `grove replan`: those of Options with a time limit
  /// of 1 second, because the robots move while the run computes.
  static Options default_options();

  /// Solves instance(), starting from the old plan, repaired where a change made it invalid. In the
  /// new plan all agents follow the old plan for the first `commit` >= 0 time steps. Options::start
  /// is ignored.
  ///
  /// An agent whose old plan ends on a visited task (see instance()) is first planned to end on one
  /// of its remaining tasks. If that gives no plan, or only one that costs more than a still valid
  /// old plan, a second search gives it the end of its old path as its destination. If the second
  /// search finds a plan, Solution::texts lists the ids of these agents under "ends_of_old_plan".
  ///
  /// If the instance has choices (Instance::has_choices()), no agent keeps a task only because the
  /// old plan gives it this task: the run chooses again, starting from the old plan. Agents
  /// exchange tasks only if this gives a better plan, and the new plan is never worse than a still
  /// valid old one. Options::visit_weight defines "better". The lower bound holds for all choices.
  ///
  /// Throws what solve() throws, and InvalidArgument with field() "/commit" if `commit` < 0 or if a
  /// path is blocked before the committed steps end.
  Solution replan(const Options& options = default_options(), int commit = 0);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace grove
