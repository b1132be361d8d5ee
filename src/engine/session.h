// SPDX-License-Identifier: MIT
// An instance and its plan while time goes on and minds change.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/solve.h"
#include "execution/change.h"
#include "execution/late.h"

namespace grove::detail {

// Keeps the map, the distances on it and the plan from one solve to the next; each begins with what
// of the plan can be kept. One thread at a time may use it.
class Session {
 public:
  explicit Session(Instance instance);
  // With a valid plan of it.
  Session(Instance instance, Plan plan);
  ~Session();
  Session(Session&&) noexcept;
  Session& operator=(Session&&) noexcept;

  // As it is now, time from 0.
  const Instance& instance() const;
  // A valid one of instance(); none before the first solve, after a change that concerns it, and
  // where none was found.
  const std::optional<Plan>& plan() const;

  // So many steps pass, >= 0, by the plan, which must be there: instance and plan are then what is
  // left of them (execution/advance.h). At their end the robots named are late and others perhaps
  // for their sake (execution/late.h). Beyond the end of the plan all stand where it ends. Throws
  // ImpossibleLateness, and nothing has changed.
  void advance(Time steps, std::span<const Late> late = {});

  // What else is to be done, or no more, and which ways are closed. The plan is no more if it does
  // not fit, but the next solve begins with it. Throws InstanceError (execution/change.h), and
  // nothing has changed.
  void change(const InstanceChange& change);

  // Solves the instance as it is: as grove::detail::solve() does, but the old plan, repaired where
  // it does not do any more, is what it starts from (options.start is not looked at). All robots
  // keep to the old plan, or what a change left of it, for `commit` steps; the plan found begins
  // with these. Then lower_bound holds for all plans; that of those that begin like this is
  // counts["lower_bound_committed"], if all agents have a destination or nothing to do (who has
  // none is to end on a task that is left, or as in the old plan). Agents whose destination is
  // there only for the sake of the old plan (advance.h) are solved without it first. Unless that
  // finds a plan, no dearer than the old one if this does still, they keep it, and
  // texts["ends_of_old_plan"] has their ids. Every plan, also those that `observer` is shown, has
  // passed the independent checker (InvalidPlan). Throws as solve() does, and NotCommitted.
  Solution solve(const SolveOptions& options, const Limits& limits, RunObserver* observer = nullptr,
                 Time commit = 0);

  // A robot's path ends, at what is closed, before the committed steps do.
  struct NotCommitted : std::invalid_argument {
    NotCommitted(AgentIndex the_agent, Time the_steps)
        : std::invalid_argument("a committed path is closed"), agent(the_agent), steps(the_steps) {}
    AgentIndex agent;
    Time steps;  // that it can keep to
  };

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace grove::detail
