// SPDX-License-Identifier: MIT
/// \file
/// An instance and its plan while time goes on and minds change.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "grove/export.hpp"
#include "grove/solve.hpp"

namespace grove {

/// A robot that is where the plan had it some steps ago.
struct Delay {
  std::string agent = {};  ///< Its id.
  int steps = 0;           ///< So many steps ago, at least 0.
};

/// \deprecated Old name of Delay; removed in 0.2.
using Late [[deprecated("use grove::Delay")]] = Delay;

/// What else is to be done, or no more, and what is closed.
struct Change {
  std::vector<Task> new_tasks = {};             ///< Of robots that there are.
  std::vector<std::string> dropped_tasks = {};  ///< Ids of tasks that nobody has to visit now.
  std::vector<Place> blocked = {};              ///< Cells, or vertices with all their roads.
};

/// Keeps the world, the distances in it and the plan from one solve to the next, which then takes
/// milliseconds. One thread at a time may use it. It owns all it holds; a session that was moved
/// from may be assigned to or destroyed, and nothing else.
class GROVE_API Session {
 public:
  /// Without a plan yet.
  explicit Session(Instance instance);
  /// With a valid plan of it. Throws InvalidArgument, "/plan", for one that is not.
  Session(Instance instance, const Plan& plan);
  ~Session();
  Session(Session&&) noexcept;             ///< Moves it.
  Session& operator=(Session&&) noexcept;  ///< Moves it.

  /// As it is now, time from 0. A robot without a destination that has visited everything is idle.
  /// One with tasks left whose plan ends on a visited task has that place as its destination until
  /// the next replan().
  Instance instance() const;
  /// A valid plan of it; none before the first replan(), after a change that concerns it, and where
  /// none was found.
  std::optional<Plan> plan() const;

  /// `steps` steps pass, by the plan, which must be there; at their end these robots are late, and
  /// others perhaps for their sake. Beyond the end of the plan all robots stand where it ends.
  /// Throws InvalidArgument, and nothing has changed: field() is "/late" if a robot is said to be
  /// later than `steps`, is named twice, or cannot be where it is said to be.
  void advance(int steps, const std::vector<Delay>& late = {});

  /// From now on it is so; the next replan() heeds it. Throws InvalidArgument, and nothing has
  /// changed, where it cannot be: a robot is on what is to be closed, or has to go there, or it is
  /// a wall; an id is taken, or there is none such. field() is "/new_tasks/<i>/...",
  /// "/dropped_tasks/<i>" or
  /// "/blocked/<i>".
  void change(const Change& change);

  /// The defaults of replan(), which are those of `grove replan`: the ones of Options, but a time
  /// limit of 1 second, for robots are driving meanwhile.
  static Options default_options();

  /// Solves what is left, from the old plan repaired. All keep to the old plan, or what is left of
  /// it, for `commit` steps, at least 0. (Options::start is not looked at.) A robot without a
  /// destination may end on any of its tasks that are left. If no plan is found that way, or none
  /// as good as the old plan, which ended on a visited task, that place stays its destination, and
  /// Solution::texts, "ends_of_old_plan", names the robot. Throws as solve() does,
  /// and InvalidArgument, "/commit", where a path is closed before the committed steps end.
  Solution replan(const Options& options = default_options(), int commit = 0);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace grove
