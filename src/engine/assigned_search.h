// SPDX-License-Identifier: MIT
// Re-planning of instances in which agents choose tasks or destinations: the search in a session.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "engine/run_observer.h"
#include "engine/solve.h"
#include "model/distance_field.h"

namespace grove::detail {

// A search that starts from an old plan.
struct AssignedSearch {
  const Instance& instance;  // has choices
  // Distances of `instance`, complete.
  const DistanceFields& distances;
  // The last plan; agents for which it is no longer valid may omit tasks and end anywhere.
  const Plan& old;
  std::vector<bool> affected;  // by AgentIndex: the agent must be planned again
  bool is_valid = false;       // `old` is a valid plan of `instance`
  Time commit = 0;             // steps of `old` with which the new plan begins

  // Searches `fixed`, which fixes the choices of `instance`, from its plan `start`. The agents in
  // `changed` must be planned again; `start` is valid for the others.
  using SearchFixed =
      std::function<Solution(const Instance& fixed, const Plan& start,
                             const std::vector<bool>& changed, const Limits&, RunObserver&)>;
  SearchFixed search;
};

// The objective of assignments: the cost, plus `options.visit_weight` times the sum of the
// times of the stated visits.
Cost objective(const Plan& plan, const SolveOptions& options);

// Searches two assignments and then, if necessary, others (head of assigned_search.cpp). If the old
// plan is valid, the result is never worse by objective(). The lower bound holds for all
// assignments. Throws what `search` throws.
Solution search_assigned(const AssignedSearch& search, const SolveOptions& options,
                         const Limits& limits, RunObserver& observer);

}  // namespace grove::detail
