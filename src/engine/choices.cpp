// SPDX-License-Identifier: MIT
#include "engine/choices.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <new>
#include <optional>
#include <string>
#include <utility>

#include "assignment/assignment.h"
#include "assignment/assignment_search.h"
#include "assignment/choice_bounds.h"
#include "assignment/route_bound.h"
#include "engine/adaptations.h"
#include "engine/checkpoint.h"
#include "engine/merged_observer.h"
#include "engine/restriction.h"
#include "model/choices.h"
#include "planning/problem.h"

namespace grove::detail {
namespace {

// Of the time that is left: for the search of the first assignment, and of each other one.
constexpr double kFirstShare = 0.5;
constexpr double kOtherShare = 0.125;
// Effort of the Lagrangian bound (about 1 s), and its share of the time at most.
constexpr std::int64_t kBoundEffort = 150'000'000;
constexpr double kBoundShare = 0.2;
constexpr int kMaxFailures = 200;  // assignments in succession that lead to no cheaper plan

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

Restriction restriction(const Instance& instance, const Assignment& assignment, Cost bound) {
  return {.instance = with_assignment(instance, assignment),
          .to_whole = [&](const Plan& plan) { return with_stated_visits(instance, plan); },
          .bound = bound,
          .plans = "plans with the chosen assignment",
          .has_no_plan = "no plan has the chosen assignment; plans with another may exist"};
}

// The limits of one search. Deterministic runs do not divide the time.
Limits part_of(const Limits& limits, const SolveOptions& options, double share) {
  const double seconds = limits.seconds_left();
  return {limits, options.deterministic ? seconds : share * seconds};
}

bool is_within(const Solution& solution, Omega omega) {
  return solution.plan && omega.accepts(solution.plan->cost, solution.lower_bound);
}

// Searches one assignment after the other, as long as a further one can lead to a cheaper plan.
class ChoicesRun {
 public:
  ChoicesRun(const Instance& instance, const SolveOptions& options, Cost bound,
             const Limits& limits, MergedObserver& merged)
      : instance_(instance), options_(options), bound_(bound), limits_(limits), merged_(merged) {}

  Solution run(AssignmentSearch& assignments, const Assignment& first) {
    Solution best = solve_one(first, kFirstShare);
    for (int failures = 0;
         failures < kMaxFailures && !limits_.stop_requested() && !is_within(best, options_.omega);
         ++failures) {
      const Cost cost = best.plan ? best.plan->cost : kInfiniteCost;
      const auto other = assignments.next(cost, limits_);
      if (!other) break;
      best = merged_result(best, solve_one(*other, kOtherShare));
      if (best.plan && best.plan->cost < cost) failures = 0;
    }
    if (!limits_.stop_requested()) best.stats.texts.erase("stopped_by");
    if (!is_within(best, options_.omega))
      best.stats.texts["remark"] = fmt::format(
          "assignments searched: {}; the lower bound is for all assignments", searched_);
    return best;
  }

 private:
  Solution solve_one(const Assignment& assignment, double share) {
    ++searched_;
    const Limits part = part_of(limits_, options_, share);
    return solve_restriction(restriction(instance_, assignment, bound_), options_, part, merged_);
  }

  const Instance& instance_;
  const SolveOptions& options_;
  const Cost bound_;
  const Limits& limits_;
  MergedObserver& merged_;
  int searched_ = 0;
};

Solution assign_and_solve(const Instance& instance, const SolveOptions& options,
                          const Limits& limits, RunObserver& observer, MergedObserver& merged) {
  const DistanceFields distances(instance, limits, options.threads);
  if (!distances.complete()) return stopped_solution(options, limits);
  if (const auto reason = infeasible_choices(instance, distances))
    return infeasible(options, *reason, observer);
  Cost bound = lower_bound_of_choices(instance, distances, limits);
  AssignmentSearch assignments(instance, distances, options.seed);
  const auto first = assignments.first(limits);
  if (!first) return without_assignment(options, limits, bound);
  RouteBound routes(assignments.routes());
  routes.improve(kBoundEffort, part_of(limits, options, kBoundShare));
  bound = std::max(bound, routes.lower_bound());
  merged.note("Assigns the tasks and goals by insertion; the lower bound is for all assignments.");
  return ChoicesRun(instance, options, bound, limits, merged).run(assignments, *first);
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
