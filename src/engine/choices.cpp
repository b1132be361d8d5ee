// SPDX-License-Identifier: MIT
#include "engine/choices.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <utility>

#include "assignment/assignment.h"
#include "assignment/assignment_search.h"
#include "assignment/choice_bounds.h"
#include "assignment/priced_instance.h"
#include "assignment/route_bound.h"
#include "engine/adaptations.h"
#include "engine/checkpoint.h"
#include "engine/merged_observer.h"
#include "engine/priced_search.h"
#include "engine/restriction.h"
#include "model/choices.h"
#include "planning/problem.h"

namespace grove::detail {
namespace {

// Of the time that is left: for the search of the first assignment, and of each other one.
constexpr double kFirstShare = 0.5;
constexpr double kOtherShare = 0.125;
// The same, if all assignments are searched at once as well.
constexpr double kFirstShareOfMany = 0.1;
constexpr double kOtherShareOfMany = 0.05;
// Effort of the Lagrangian bound (about 1 s), and its share of the time at most.
constexpr std::int64_t kBoundEffort = 150'000'000;
constexpr double kBoundShare = 0.2;
constexpr std::int64_t kPricedEffort = 2'000'000;  // per further assignment
constexpr Cost kMaxReach = 100;    // above twice the bound, after all plans were too many
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

// Searches one assignment after the other for plans, and all assignments at once for a bound. Ends
// when the search over all assignments is over, or is not possible, and no further assignment leads
// to a cheaper plan.
class ChoicesRun {
 public:
  ChoicesRun(const Instance& instance, const SolveOptions& options, const Limits& limits,
             MergedObserver& merged)
      : instance_(instance), options_(options), limits_(limits), merged_(merged) {}

  Solution run(AssignmentSearch& assignments, const Assignment& first, RouteBound& routes,
               Cost bound) {
    bound_ = bound;
    if (!can_price_choices(instance_)) reach_ = 0;
    best_ = solve_one(first, reach_ > 0 ? kFirstShareOfMany : kFirstShare);
    int failures = 0;
    bool has_assignment = true;
    while (!limits_.stop_requested() && !is_within(best_, options_.omega)) {
      const bool has_priced = search_priced(routes);
      if (is_within(best_, options_.omega)) break;
      has_assignment = has_assignment && failures < kMaxFailures;
      if (!has_priced && !has_assignment) break;
      if (!has_assignment) continue;
      const auto other = assignments.next(cost(), limits_);
      has_assignment = other.has_value();
      if (!other) continue;
      const Cost before = cost();
      best_ = merged_result(best_, solve_one(*other, reach_ > 0 ? kOtherShareOfMany : kOtherShare));
      failures = cost() < before ? 0 : failures + 1;
    }
    return finish();
  }

 private:
  std::optional<Cost> incumbent() const {
    return best_.plan ? std::optional(best_.plan->cost) : std::nullopt;
  }
  Cost cost() const { return incumbent().value_or(kInfiniteCost); }

  Solution solve_one(const Assignment& assignment, double share) {
    ++searched_;
    const Limits part = part_of(limits_, options_, share);
    return solve_restriction(restriction(instance_, assignment, bound_), options_, part, merged_);
  }

  // Returns false if the search over all assignments is over, or is not possible. It first
  // considers all plans below the incumbent. If there are too many, it considers those that cost at
  // most `reach_` more than the bound; if none of these exists, the bound rises, and it is
  // repeated.
  bool search_priced(RouteBound& routes) {
    if (reach_ == 0) return false;
    if (!priced_) {
      cutoff_ = reach_ < cost() - bound_ ? bound_ + reach_ : cost();
      priced_ = PricedSearch::make(instance_, routes, cutoff_, options_, limits_);
    }
    cutoff_ = std::min(cutoff_, cost());
    const bool is_open = priced_ && priced_->run(cutoff_, kPricedEffort);
    if (priced_) use_priced();
    if (is_open || limits_.stop_requested()) return is_open;
    if (priced_) end_priced();
    if (bound_ < cutoff_) reach_ = std::min({reach_, cutoff_ - bound_, bound_ + kMaxReach}) / 2;
    return reach_ > 0;
  }

  void use_priced() {
    const Cost proven = std::min(priced_->lower_bound(), cutoff_);
    if (proven >= kInfiniteCost) return;  // there is no plan, but limits may have been reached
    const bool is_news = proven > bound_;
    bound_ = std::max(bound_, proven);
    best_.lower_bound = bound_;
    Progress progress{.lower_bound = bound_, .incumbent = incumbent()};
    merged_.begin_search();
    if (is_news) {
      merged_.outside_bound(ComponentId::kCores);
      merged_.event(RunEvent::kBound, progress);
    }
    if (const std::optional<Plan>& plan = priced_->plan(); plan && plan->cost < cost()) {
      best_.plan = plan;
      progress.incumbent = plan->cost;
      progress.lower_bound = bound_ =
          std::max(bound_, std::min(priced_->lower_bound(), plan->cost));
      merged_.incumbent(*plan, PlanSource::kCores, progress);
      merged_.event(RunEvent::kIncumbent, progress);
    }
    best_.lower_bound = bound_;
    best_.status = status_of(incumbent(), bound_, options_.omega);
  }

  void end_priced() {
    Counters counters;
    priced_->add_counts(counters);
    add(counters, best_.stats.counts);
    priced_.reset();
  }

  Solution finish() {
    if (priced_) end_priced();
    if (!limits_.stop_requested() || is_within(best_, options_.omega))
      best_.stats.texts.erase("stopped_by");
    if (!is_within(best_, options_.omega))
      best_.stats.texts["remark"] = fmt::format(
          "assignments searched: {}; the lower bound is for all assignments", searched_);
    else
      best_.stats.texts.erase("remark");
    return std::move(best_);
  }

  const Instance& instance_;
  const SolveOptions& options_;
  const Limits& limits_;
  MergedObserver& merged_;
  Cost bound_ = 0;  // for all assignments
  Solution best_;
  std::unique_ptr<PricedSearch> priced_;
  Cost cutoff_ = kInfiniteCost;  // of priced_
  Cost reach_ = kInfiniteCost;   // how far above the bound it searches at most; 0: not at all
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
  return ChoicesRun(instance, options, limits, merged).run(assignments, *first, routes, bound);
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
