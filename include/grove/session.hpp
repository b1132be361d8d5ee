// SPDX-License-Identifier: MIT
/// \file
/// Re-planning: an instance and its plan during execution.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "grove/export.hpp"
#include "grove/solve.hpp"

namespace grove {

/// Delay of a robot: it is where the plan had it `steps` time steps earlier.
struct Delay {
  std::string agent = {};  ///< Id of the robot.
  int steps = 0;           ///< Time steps, >= 0.
};

/// \deprecated Old name of Delay; removed in 0.2.
using Late [[deprecated("use grove::Delay")]] = Delay;

/// Changes of an instance.
struct Change {
  std::vector<Task> new_tasks = {};             ///< For existing robots.
  std::vector<std::string> dropped_tasks = {};  ///< Ids of tasks that no robot has to visit.
  std::vector<Place> blocked = {};  ///< Cells to block, or vertices with all their roads.
};

/// Keeps the world, its distances and the plan from one run to the next, so that re-planning takes
/// milliseconds. One thread at a time. Owns its data. A session that was moved from may only be
/// assigned to or destroyed.
class GROVE_API Session {
 public:
  /// Creates a session without a plan.
  explicit Session(Instance instance);
  /// Creates a session with a plan of the instance. Throws InvalidArgument with field() "/plan" if
  /// the plan is not valid.
  Session(Instance instance, const Plan& plan);
  ~Session();
  Session(Session&&) noexcept;             ///< Move constructor.
  Session& operator=(Session&&) noexcept;  ///< Move assignment.

  /// Returns the instance from now on; the current time is 0. A robot without a destination that
  /// has visited all its tasks is idle. A robot with tasks left whose plan ends on a visited task
  /// has that place as its destination until the next replan().
  Instance instance() const;
  /// Returns a valid plan of instance(); std::nullopt before the first replan(), after a change
  /// that makes the plan invalid, and if no plan was found.
  std::optional<Plan> plan() const;

  /// Advances the session by `steps` time steps along its plan. Afterwards each robot in `late` is
  /// Delay::steps behind the plan, and its delay propagates to the robots that must wait for it.
  /// After the end of the plan all robots rest. Replaces instance() and plan() by what remains of
  /// them, with time counted from 0.
  ///
  /// Throws InvalidArgument and leaves the session unchanged. field() is "" without a plan,
  /// "/steps" if steps < 0, "/late/<i>" for an unknown robot or a negative delay, "/late" for a
  /// delay above `steps`, a robot that is named twice, or a delay that is impossible.
  void advance(int steps, const std::vector<Delay>& late = {});

  /// Changes the instance; the next replan() takes it into account. Throws InvalidArgument and
  /// leaves the session unchanged if the change is impossible: a robot is on a place to block or
  /// must go there, the place is blocked already, an id is taken or unknown. field() is
  /// "/new_tasks/<i>/...", "/dropped_tasks/<i>" or "/blocked/<i>".
  void change(const Change& change);

  /// Returns the default options of replan() and `grove replan`: those of Options, with a time
  /// limit of 1 second, because the robots drive during the run.
  static Options default_options();

  /// Solves the remaining instance, starting from the repaired old plan. All robots follow the old
  /// plan for `commit` >= 0 time steps. Options::start is ignored. A robot without a destination
  /// may end on any of its remaining tasks. If this gives no plan, or none as good as the old plan,
  /// which ended on a visited task, that place stays its destination, and Solution::texts,
  /// "ends_of_old_plan", names the robot. Throws like solve(), and InvalidArgument with field()
  /// "/commit" if a path is blocked before the committed steps end.
  Solution replan(const Options& options = default_options(), int commit = 0);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace grove
