// SPDX-License-Identifier: MIT
// Re-planning session: an instance and its plan, which advance in time and can change.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/solve.h"
#include "execution/change.h"
#include "execution/delay.h"

namespace grove::detail {

// Keeps the map, the distances on it and the plan between solves. Each solve starts from the part
// of the plan that is still valid. One thread at a time.
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
  // A valid plan of instance(). nullopt if the session has had no plan yet, or if change() has
  // reset it and no solve has found a plan since.
  const std::optional<Plan>& plan() const;

  // Advances by `steps` >= 0 time steps along the plan, which must exist. At the end of these steps
  // the robots in `late` are late, and their delays propagate to the robots that wait for them
  // (execution/delay.h). After the end of its path a robot rests. Replaces instance() and plan() by
  // what remains of them (execution/advance.h). Throws InfeasibleDelay and then leaves the session
  // unchanged.
  void advance(Time steps, std::span<const Delay> late = {});

  // Adds or drops tasks and closes parts of the map. If the old plan is no longer valid or a task
  // was dropped, plan() becomes nullopt, but the next solve still starts from the old plan. Throws
  // InstanceError (execution/change.h) and then leaves the session unchanged.
  void change(const InstanceChange& change);

  // Solves the current instance as grove::detail::solve() does. The search starts from the old
  // plan, repaired where it is invalid; options.start is ignored.
  //
  // If `commit` > 0, the new plan starts with the first `commit` steps of the old plan, or of the
  // part of it that a change left. lower_bound then holds for all plans. The bound on the plans
  // that start with the committed steps is counts["lower_bound_committed"]. It is set only if each
  // agent may still rest wherever it may in the original instance. Otherwise it would be no valid
  // bound, because after the committed steps the search lets an agent without a destination end
  // only on a remaining task or as in the old plan.
  //
  // The instance is first solved without the destinations that agents have only because of the old
  // plan (execution/advance.h). If that finds no plan, or one that costs more than a still valid
  // old plan, a second search keeps these destinations. If the second search finds a plan,
  // texts["ends_of_old_plan"] lists the ids of these agents.
  //
  // If the instance has choices, the agents keep no task of the old plan: the search chooses an
  // assignment again, starting from that of the old plan (engine/assigned_search.h). The result is
  // never worse by objective() than a still valid old plan. lower_bound then holds for all
  // assignments, and counts["lower_bound_committed"] is not set.
  //
  // The independent checker has verified every plan, including those passed to `observer`. Throws
  // what solve() throws, InvalidPlan, and NotCommitted.
  Solution solve(const SolveOptions& options, const Limits& limits, RunObserver* observer = nullptr,
                 Time commit = 0);

  // Thrown if a robot's path ends at a closed part of the map before the committed steps end.
  struct NotCommitted : std::invalid_argument {
    NotCommitted(AgentIndex the_agent, Time the_steps)
        : std::invalid_argument("a committed path uses a closed place"),
          agent(the_agent),
          steps(the_steps) {}
    AgentIndex agent;
    Time steps;  // number of steps for which the robot can follow the old plan
  };

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace grove::detail
