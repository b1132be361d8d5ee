// SPDX-License-Identifier: MIT
// Parts of the searches that solve an instance with choices by one assignment after the other.
#pragma once

#include <string>

#include "assignment/assignment.h"
#include "engine/restriction.h"
#include "engine/run_observer.h"
#include "engine/solve.h"
#include "model/limits.h"

namespace grove::detail {

// The limits of a search that may use `share` of the time that is left. Deterministic runs do not
// divide the time.
Limits part_of(const Limits& limits, const SolveOptions& options, double share);

// The time since `start`, by which searches take turns: seconds. Deterministic runs count calls
// instead, so the result is 1.
double turn_seconds(const SolveOptions& options, const Limits& limits,
                    Limits::Clock::time_point start);

// The restriction of `instance`, which must outlive it, to an assignment. `bound`, `cutoff`: see
// Restriction. Throws InstanceError like with_assignment().
Restriction restriction_to(const Instance& instance, const Assignment& assignment, Cost bound,
                           Cost cutoff = kInfiniteCost);

Solution infeasible_solution(const SolveOptions& options, const std::string& reason);
// Also reports to `observer` that there is no plan.
Solution infeasible_solution(const SolveOptions& options, const std::string& reason,
                             RunObserver& observer);

// The reason if lower_bound_of_choices() is infinite.
inline constexpr const char* kNoWayToGoals =
    "the agents cannot visit the tasks that they must visit and then reach different goals";
inline constexpr const char* kNoAssignmentFound =
    "the insertion heuristic found no assignment; one may exist";
// The result if there is no assignment to search. If no limit is the reason, `remark` states it.
Solution without_assignment(const SolveOptions& options, const Limits& limits, Cost bound,
                            const std::string& remark = kNoAssignmentFound);

// The solution with another plan, and the status of this plan.
Solution with_plan(Solution solution, const Plan& plan);

}  // namespace grove::detail
