// SPDX-License-Identifier: MIT
#include "engine/choices.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <new>
#include <optional>
#include <utility>

#include "assignment/assignment.h"
#include "assignment/assignment_search.h"
#include "assignment/choice_bounds.h"
#include "assignment/choice_neighborhoods.h"
#include "assignment/exchange_search.h"
#include "assignment/implied_tasks.h"
#include "assignment/infeasible_choices.h"
#include "assignment/instance_routes.h"
#include "assignment/priced_instance.h"
#include "assignment/route_bound.h"
#include "engine/all_assignments.h"
#include "engine/checkpoint.h"
#include "engine/choices_bounds.h"
#include "engine/choices_result.h"
#include "engine/merged_observer.h"
#include "engine/single_assignment.h"
#include "model/check.h"
#include "model/choices.h"
#include "planning/problem.h"

namespace grove::detail {
namespace {

// Of the time that is left: for the search of the first assignment, and of each other one.
constexpr double kFirstShare = 0.5;
constexpr double kOtherShare = 0.125;
// The same, if all assignments are searched at once as well.
constexpr double kFirstShareWithAll = 0.1;
constexpr double kOtherShareWithAll = 0.05;
constexpr std::int64_t kExchangeEffort = 300'000;  // per turn without an improvement, about 0.1 s
constexpr std::int64_t kNeighborhoodEffort = 1'000'000;  // of the core-guided search
constexpr int kFailuresWithoutAssignment = 20;  // added to the failures if no assignment is found
constexpr int kMaxFailures = 200;  // assignments in succession that lead to no cheaper plan

// Three primal heuristics, which get equal time: searches of one assignment after the other;
// exchanges of tasks and goals between agents of the best plan; core-guided search of its
// neighbourhoods.
class PlanSearches {
 public:
  PlanSearches(const Instance& instance, const SolveOptions& options, const Limits& limits,
               AssignmentSearch& assignments, ExchangeSearch& exchanges,
               ChoiceNeighborhoods& neighborhoods, ChoicesResult& result)
      : options_(options),
        limits_(limits),
        has_neighborhoods_(AllAssignmentsSearch::is_available(options) &&
                           has_optional_tasks(instance)),
        assignments_(assignments),
        exchanges_(exchanges),
        neighborhoods_(neighborhoods),
        result_(result) {}

  void search_first(const Assignment& first, bool with_bounds) {
    result_.search(first, with_bounds ? kFirstShareWithAll : kFirstShare);
  }

  // Is there a further assignment to search?
  bool can_search_assignments() const { return failures_ < kMaxFailures; }
  bool can_search() const { return can_search_assignments() || result_.plan(); }

  // Precondition: can_search().
  void search(bool with_bounds) {
    const auto start = limits_.now();
    double* spent = &spent_on_assignments_;
    if (result_.plan() && (spent_on_exchanges_ <= *spent || !can_search_assignments()))
      spent = &spent_on_exchanges_;
    if (can_search_neighborhoods() && spent_on_neighborhoods_ <= *spent)
      spent = &spent_on_neighborhoods_;
    const Cost before = result_.cost();
    try {
      if (spent == &spent_on_assignments_)
        search_next(with_bounds);
      else if (spent == &spent_on_exchanges_)
        exchange();
      else
        search_neighborhood();
    } catch (const std::bad_alloc&) {
      limits_.memory_exhausted();
    }
    if (result_.cost() < before) failures_ = 0;
    *spent += turn_seconds(options_, limits_, start);
  }

  double spent() const {
    return spent_on_assignments_ + spent_on_exchanges_ + spent_on_neighborhoods_;
  }

 private:
  void search_next(bool with_bounds) {
    const auto next = assignments_.next(result_.cost(), limits_);
    if (next) result_.search(*next, with_bounds ? kOtherShareWithAll : kOtherShare);
    failures_ += next ? 1 : kFailuresWithoutAssignment;
  }

  void exchange() {
    if (exchanged_ != result_.cost()) exchanges_.start_from(*result_.plan());
    while (auto plan = exchanges_.improve(result_.cost(), kExchangeEffort, limits_)) {
      result_.use_plan(std::move(*plan), PlanSource::kLns);
      if (result_.is_final()) break;
    }
    exchanged_ = result_.cost();
  }

  bool can_search_neighborhoods() const {
    return has_neighborhoods_ && result_.plan() && without_neighborhoods_ != result_.cost();
  }

  void search_neighborhood() {
    if (std::exchange(with_neighborhoods_, result_.cost()) != result_.cost())
      neighborhoods_.start_from(*result_.plan(), limits_);
    if (RouteBound* const choices = neighborhoods_.next(limits_))
      result_.search(*choices, kNeighborhoodEffort);
    else if (neighborhoods_.is_over())
      without_neighborhoods_ = result_.cost();
  }

  const SolveOptions& options_;
  const Limits& limits_;
  const bool has_neighborhoods_;
  AssignmentSearch& assignments_;
  ExchangeSearch& exchanges_;
  ChoiceNeighborhoods& neighborhoods_;
  ChoicesResult& result_;
  int failures_ = 0;  // assignments in succession without a cheaper plan
  // Cost of the plan from which exchanges continue, of the plan whose neighbourhoods are drawn, and
  // of the plan whose neighbourhoods are exhausted.
  Cost exchanged_ = kInfiniteCost;
  Cost with_neighborhoods_ = kInfiniteCost;
  Cost without_neighborhoods_ = kInfiniteCost;
  // Seconds; in deterministic runs, calls.
  double spent_on_assignments_ = 0;
  double spent_on_exchanges_ = 0;
  double spent_on_neighborhoods_ = 0;
};

// Bounding searches and primal heuristics get equal time. Ends when no bounding search can continue
// and no assignment is left. `spent`: time already spent on bounds.
void search_in_turns(const SolveOptions& options, const Limits& limits, const Assignment& first,
                     PlanSearches& plans, ChoicesBounds& bounds, const ChoicesResult& result,
                     double spent) {
  plans.search_first(first, bounds.can_search_all());
  while (!limits.stop_requested() && !result.is_final() &&
         (bounds.can_improve() || plans.can_search_assignments())) {
    if (bounds.can_improve() && (spent <= plans.spent() || !plans.can_search())) {
      const auto start = limits.now();
      bounds.improve();
      spent += turn_seconds(options, limits, start);
    } else {
      plans.search(bounds.can_search_all());
    }
  }
}

Solution assign_and_solve(const Instance& instance, const SolveOptions& options,
                          const Limits& limits, RunObserver& observer, MergedObserver& merged) {
  const DistanceFields distances(instance, limits, options.threads);
  if (!distances.complete()) return stopped_solution(options, limits);
  if (const auto reason = infeasible_choices(instance, distances))
    return infeasible_solution(options, *reason, observer);
  Cost bound = lower_bound_of_choices(instance, distances, limits);
  if (bound >= kInfiniteCost) return infeasible_solution(options, kNoWayToGoals, observer);
  AssignmentSearch assignments(instance, distances, options.seed);
  const auto first = assignments.first(limits);
  if (!first) return without_assignment(options, limits, options.proof ? 0 : bound);
  RouteBound route_bound(assignments.routes());
  const auto start = limits.now();
  improve_routes(route_bound, options, limits);
  const double spent = options.deterministic ? 0 : turn_seconds(options, limits, start);
  bound = std::max(bound, route_bound.lower_bound());
  merged.note(
      "Searches assignments of tasks and goals; the lower bound holds for all assignments.");
  ExchangeSearch exchanges(instance, distances, assignments.routes(), options.seed);
  ChoiceNeighborhoods neighborhoods(instance, assignments.routes(), route_bound, options.seed);
  ChoicesResult result(instance, options, limits, merged, bound);
  ChoicesBounds bounds(instance, options, limits, merged, route_bound, result);
  PlanSearches plans(instance, options, limits, assignments, exchanges, neighborhoods, result);
  search_in_turns(options, limits, *first, plans, bounds, result, spent);
  return result.finish();
}

Solution solve_choices(const Instance& instance, const SolveOptions& options, const Limits& limits,
                       RunObserver& observer) {
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

// Converts the plans of the search without implied tasks.
class WholePlans : public ForwardingObserver {
 public:
  WholePlans(RunObserver& next, const WithoutImpliedTasks& reduced)
      : ForwardingObserver(next), reduced_(reduced) {}
  void on_incumbent(const Plan& plan, PlanSource source, const Progress& progress) override {
    next().on_incumbent(reduced_.to_whole(plan), source, progress);
  }

 private:
  const WithoutImpliedTasks& reduced_;
};

}  // namespace

Solution solve_with_choices(const Instance& instance, const SolveOptions& options,
                            const Limits& limits, RunObserver& observer) {
  if (options.policy == Policy::kFixed) return solve(instance, options, limits, &observer);
  const auto reduced = WithoutImpliedTasks::make(instance);
  if (!reduced) return solve_choices(instance, options, limits, observer);
  WholePlans whole_plans(observer, *reduced);
  Solution solution = reduced->instance().has_choices()
                          ? solve_choices(reduced->instance(), options, limits, whole_plans)
                          : solve(reduced->instance(), options, limits, &whole_plans);
  if (solution.plan) solution.plan = checked_plan(instance, reduced->to_whole(*solution.plan));
  return solution;
}

void require_choices_fit(const Instance& instance, const SolveOptions& options) {
  if (options.policy == Policy::kFixed)
    require_joint_routes(instance, "policy fixed does not support", "policy free");
  if (options.start) require_no_choices(instance, "a start plan does not support", "no start plan");
  if (!options.checkpoints.directory.empty() || options.resume)
    require_no_choices(instance, "checkpoints do not support", "no checkpoints");
  if (options.proof && options.policy == Policy::kFixed)
    require_no_choices(instance, "proofs with policy fixed do not support", "policy free");
  if (options.proof) require_certified_choices(instance);
}

void require_certified_choices(const Instance& instance) {
  if (const auto choice = find_uncertified_choice(instance))
    throw InstanceError(choice->field, refusal_text(*choice, "proofs do not support", "no proof"));
}

}  // namespace grove::detail
