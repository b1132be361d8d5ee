// SPDX-License-Identifier: MIT
// Re-planning session: an instance and its plan, which advance in time and change.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/solve.h"
#include "execution/change.h"
#include "execution/delay.h"

namespace grove::detail {

// Keeps the map, the distances on it and the plan between two solves. Each solve starts from what
// can be kept of the plan. One thread at a time.
class Session {
 public:
  explicit Session(Instance instance);
  // `plan` must be a valid plan of `instance`.
  Session(Instance instance, Plan plan);
  ~Session();
  Session(Session&&) noexcept;
  Session& operator=(Session&&) noexcept;

  // The current instance, with time counted from 0.
  const Instance& instance() const;
  // A valid plan of instance(). nullopt before the first solve, after a change that invalidates it,
  // and if a solve found none.
  const std::optional<Plan>& plan() const;

  // Advances by `steps` >= 0 steps along the plan, which must exist. Afterwards instance() and
  // plan() are what remains of them (execution/advance.h). At the end of these steps the robots in
  // `late` are late, and their delays propagate to the robots that wait for them
  // (execution/delay.h). Beyond the end of the plan each robot stays where its path ends. Throws
  // InfeasibleDelay and leaves the session unchanged.
  void advance(Time steps, std::span<const Delay> late = {});

  // Adds or drops tasks and closes parts of the map. If the old plan does not fit any more, plan()
  // becomes nullopt, but the next solve starts from the old plan. Throws InstanceError
  // (execution/change.h) and leaves the session unchanged.
  void change(const InstanceChange& change);

  // Solves the current instance as grove::detail::solve() does. The search starts from the old
  // plan, repaired where it is invalid; options.start is ignored.
  //
  // All robots keep to the old plan, or to what a change left of it, for `commit` steps; the new
  // plan begins with these steps. In this case lower_bound holds for all plans. The bound for the
  // plans that begin with the committed steps is counts["lower_bound_committed"]. It is present if
  // each agent has a destination or nothing to do; an agent without a destination must end on a
  // remaining task, or as in the old plan.
  //
  // Agents whose destination exists only because of the old plan (advance.h) are first solved
  // without it. If that finds no plan, or one that costs more than a still valid old plan, they
  // keep the destination, and texts["ends_of_old_plan"] lists their ids.
  //
  // Every plan, including those passed to `observer`, has passed the independent checker
  // (InvalidPlan). Throws as solve() does, and NotCommitted.
  Solution solve(const SolveOptions& options, const Limits& limits, RunObserver* observer = nullptr,
                 Time commit = 0);

  // Thrown if a robot's path ends at a closed part of the map before the committed steps do.
  struct NotCommitted : std::invalid_argument {
    NotCommitted(AgentIndex the_agent, Time the_steps)
        : std::invalid_argument("a committed path is closed"), agent(the_agent), steps(the_steps) {}
    AgentIndex agent;
    Time steps;  // that the robot can keep to
  };

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace grove::detail
