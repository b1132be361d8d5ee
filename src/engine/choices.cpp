// SPDX-License-Identifier: MIT
#include "engine/choices.h"

#include <new>
#include <optional>
#include <string>
#include <utility>

#include "assignment/assignment.h"
#include "assignment/choice_bounds.h"
#include "assignment/insertion.h"
#include "engine/checkpoint.h"
#include "engine/merged_observer.h"
#include "engine/restriction.h"
#include "model/choices.h"
#include "planning/problem.h"

namespace grove::detail {
namespace {

Solution infeasible(const SolveOptions& options, const std::string& reason, RunObserver& observer) {
  observer.on_infeasible(reason);
  Solution solution;
  solution.status = Status::kInfeasible;
  solution.omega = options.omega;
  solution.stats.texts["reason"] = reason;
  return solution;
}

Solution without_assignment(const SolveOptions& options, const Limits& limits, Cost bound) {
  Solution solution;
  if (limits.stop_requested()) {
    solution = stopped_solution(options, limits);
  } else {
    solution.omega = options.omega;
    solution.stats.texts["remark"] = "insertion found no assignment; there may be one";
  }
  solution.lower_bound = bound;
  return solution;
}

Solution assign_and_solve(const Instance& instance, const SolveOptions& options,
                          const Limits& limits, RunObserver& observer, MergedObserver& merged) {
  const DistanceFields distances(instance, limits, options.threads);
  if (!distances.complete()) return stopped_solution(options, limits);
  if (const auto reason = infeasible_choices(instance, distances))
    return infeasible(options, *reason, observer);
  const Cost bound = lower_bound_of_choices(instance, distances, limits);
  const auto assignment = assignment_by_insertion(instance, distances, options.seed, limits);
  if (!assignment) return without_assignment(options, limits, bound);

  merged.note("Insertion assigns the tasks and goals; the lower bound is for all assignments.");
  const Restriction restriction{
      .instance = with_assignment(instance, *assignment),
      .to_whole = [&](const Plan& plan) { return with_stated_visits(instance, plan); },
      .bound = bound,
      .plans = "plans with the chosen assignment",
      .has_no_plan = "no plan has the chosen assignment; plans with another assignment may exist"};
  return solve_restriction(restriction, options, limits, merged);
}

}  // namespace

Solution solve_with_choices(const Instance& instance, const SolveOptions& options,
                            const Limits& limits, RunObserver& observer) {
  MergedObserver merged(observer);
  Solution solution;
  try {
    solution = assign_and_solve(instance, options, limits, observer, merged);
  } catch (const std::bad_alloc&) {  // before the search, which handles its own exceptions
    limits.memory_exhausted();
    solution = stopped_solution(options, limits);
  }
  merged.end();
  return solution;
}

void require_choices_fit(const Instance& instance, const SolveOptions& options) {
  if (options.policy == Policy::kFixed)
    require_no_choices(instance, "policy fixed does not support");
  if (options.start) require_no_choices(instance, "a start plan does not support");
  if (!options.checkpoints.directory.empty() || options.resume)
    require_no_choices(instance, "checkpoints do not support");
  if (options.proof) require_no_choices(instance, "proofs do not support");
}

}  // namespace grove::detail
