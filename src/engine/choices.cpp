// SPDX-License-Identifier: MIT
#include "engine/choices.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <utility>

#include "assignment/assignment.h"
#include "assignment/assignment_search.h"
#include "assignment/choice_bounds.h"
#include "assignment/exchange_search.h"
#include "assignment/implied_tasks.h"
#include "assignment/infeasible_choices.h"
#include "assignment/instance_routes.h"
#include "assignment/priced_instance.h"
#include "assignment/route_bound.h"
#include "engine/adaptations.h"
#include "engine/all_assignments.h"
#include "engine/checkpoint.h"
#include "engine/merged_observer.h"
#include "engine/restriction.h"
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
// Effort of the Lagrangian bound (about 1 s), and its share of the time at most.
constexpr std::int64_t kBoundEffort = 150'000'000;
constexpr double kBoundShare = 0.2;
constexpr std::int64_t kAllEffort = 2'000'000;     // per further assignment
constexpr std::int64_t kExchangeEffort = 300'000;  // of exchanges without a gain, about 0.1 s
constexpr Cost kMarginOffset = 100;  // after a failure the margin is at most half of this + bound
constexpr int kFailuresWithoutAssignment = 20;  // that count if no assignment is found
constexpr int kMaxFailures = 200;  // assignments in succession that lead to no cheaper plan

bool is_within(const Solution& solution, Omega omega) {
  return solution.plan && omega.accepts(solution.plan->cost, solution.lower_bound);
}

// Searches one assignment after the other for plans, exchanges tasks and goals between the agents
// of the best plan, and searches all assignments at once for a bound. Ends when the search over all
// assignments is over, or is not possible, and no further assignment leads to a cheaper plan.
class ChoicesRun {
 public:
  ChoicesRun(const Instance& instance, const SolveOptions& options, const Limits& limits,
             MergedObserver& merged, ExchangeSearch& exchanges)
      : instance_(instance),
        options_(options),
        limits_(limits),
        merged_(merged),
        exchanges_(exchanges) {
    of_one_.proof = nullptr;
  }

  // `spent`: seconds that were spent on the bound.
  Solution run(AssignmentSearch& assignments, const Assignment& first, RouteBound& route_bound,
               Cost bound, double spent) {
    bound_ = bound;
    if (!options_.deterministic) spent_on_bounds_ = spent;
    best_ = solve_one(first, can_search_all() ? kFirstShareWithAll : kFirstShare);
    while (!limits_.stop_requested() && !is_over() && (can_search_all() || can_search_next())) {
      const bool can_search_plans = can_search_next() || best_.plan;
      const bool is_turn_of_bounds =
          can_search_all() && (spent_on_bounds_ <= spent_on_plans() || !can_search_plans);
      if (is_turn_of_bounds)
        search_bounds(route_bound);
      else
        search_plans(assignments);
    }
    return finish();
  }

 private:
  bool is_over() const {
    return best_.status == Status::kInfeasible || is_within(best_, options_.omega);
  }
  std::optional<Cost> incumbent() const {
    return best_.plan ? std::optional(best_.plan->cost) : std::nullopt;
  }
  Cost cost() const { return incumbent().value_or(kInfiniteCost); }
  // The lower bound that decides when the run ends: with a proof, the certified one.
  Cost reported() const { return options_.proof ? certified_ : bound_; }

  Solution solve_one(const Assignment& assignment, double share) {
    ++searched_;
    const Limits part = part_of(limits_, options_, share);
    return solve_restriction(restriction_to(instance_, assignment, reported(), cost()), of_one_,
                             part, merged_);
  }

  bool can_search_all() const { return cutoff_margin_ > 0; }
  double spent_on_plans() const { return spent_on_exchanges_ + spent_on_assignments_; }
  bool can_search_next() const { return failures_ < kMaxFailures; }

  // Deterministic runs count calls instead.
  double seconds_since(Limits::Clock::time_point start) const {
    if (options_.deterministic) return 1;
    return std::chrono::duration<double>(limits_.now() - start).count();
  }

  void search_bounds(RouteBound& route_bound) {
    const auto start = limits_.now();
    search_all(route_bound);
    spent_on_bounds_ += seconds_since(start);
  }

  // Further assignments and exchanges between the agents of the incumbent get equal time.
  void search_plans(AssignmentSearch& assignments) {
    const bool is_turn_of_exchanges =
        best_.plan && (spent_on_exchanges_ <= spent_on_assignments_ || !can_search_next());
    const auto start = limits_.now();
    if (is_turn_of_exchanges)
      exchange();
    else
      search_next(assignments);
    (is_turn_of_exchanges ? spent_on_exchanges_ : spent_on_assignments_) += seconds_since(start);
  }

  void exchange() {
    try {
      if (exchanged_from_ != cost()) exchanges_.start_from(*best_.plan);
      while (auto plan = exchanges_.improve(cost(), kExchangeEffort, limits_)) {
        use_exchanged(std::move(*plan));
        if (is_over()) break;
      }
      exchanged_from_ = cost();
    } catch (const std::bad_alloc&) {
      limits_.memory_exhausted();
    }
  }

  void use_exchanged(Plan plan) {
    failures_ = 0;
    best_.plan = std::move(plan);
    state_bound(reported());
    merged_.incumbent(*best_.plan, PlanSource::kLns, progress());
    report(RunEvent::kIncumbent);
  }

  void search_next(AssignmentSearch& assignments) {
    const auto next = assignments.next(cost(), limits_);
    if (!next) {
      failures_ += kFailuresWithoutAssignment;
      return;
    }
    const Cost before = cost();
    best_ =
        merged_result(best_, solve_one(*next, can_search_all() ? kOtherShareWithAll : kOtherShare));
    failures_ = cost() < before ? 0 : failures_ + 1;
  }

  // Searches all assignments for a while. It first considers all plans below the incumbent. If
  // these are too many, it considers only plans that cost less than the bound plus
  // `cutoff_margin_`, and better multipliers, with which fewer choices remain. If it proves that
  // there are none, the bound rises to this cutoff, and the step repeats.
  void search_all(RouteBound& route_bound) {
    if (!all_) {
      announce_all();
      cutoff_ = cutoff_margin_ < cost() - bound_ ? bound_ + cutoff_margin_ : cost();
      all_ = AllAssignmentsSearch::make(instance_, route_bound, cutoff_, options_, limits_);
    }
    cutoff_ = std::min(cutoff_, cost());
    const bool is_open = all_ && all_->run(cutoff_, kAllEffort, [this] { use_result_of_all(); });
    if (all_) use_result_of_all();
    if (is_open || limits_.stop_requested()) return;
    if (all_) end_all();
    if (reported() >= cutoff_) return;
    cutoff_margin_ = std::min({cutoff_margin_, cutoff_ - bound_, bound_ + kMarginOffset}) / 2;
    if (!route_bound.can_improve()) return;
    route_bound.improve(kBoundEffort, part_of(limits_, options_, kBoundShare));
    raise_bound(route_bound.lower_bound());
    cutoff_margin_ = std::max<Cost>(cutoff_margin_, 1);
  }

  void announce_all() {
    if (!std::exchange(has_announced_all_, true))
      merged_.note(
          "Searches all assignments at once by unsatisfiable cores, in turn with single ones.");
  }

  void use_result_of_all() {
    const Cost proven = std::min(all_->lower_bound(), cutoff_);
    if (proven >= kInfiniteCost) return prove_infeasible();
    if (const std::optional<Plan>& plan = all_->plan(); plan && plan->cost < cost())
      best_.plan = plan;
    else if (proven <= reported())
      return report(RunEvent::kProgress);
    const bool is_plan = all_->plan() && best_.plan->cost == all_->plan()->cost;
    certified_ = std::max(certified_, std::min(proven, cost()));
    set_bound(std::max(bound_, proven));
    merged_.outside_bound(ComponentId::kCores);
    if (is_plan) merged_.incumbent(*best_.plan, PlanSource::kCores, progress());
    report(is_plan ? RunEvent::kIncumbent : RunEvent::kBound);
  }

  void raise_bound(Cost proven) {
    if (proven <= bound_) return;
    set_bound(proven);
    merged_.outside_bound(ComponentId::kLagrangian);
    report(RunEvent::kBound);
  }

  void set_bound(Cost proven) {
    bound_ = std::min(proven, cost());
    state_bound(reported());
    merged_.begin_search();
  }

  void state_bound(Cost bound) {
    best_.lower_bound = bound;
    best_.status = status_of(incumbent(), bound, options_.omega);
  }

  Progress progress() const { return {.lower_bound = reported(), .incumbent = incumbent()}; }

  void report(RunEvent event) {
    std::map<std::string, std::int64_t> counts;
    add(outside_counters(), counts);
    merged_.event_outside(event, progress(), std::move(counts));
  }

  // The counters of the run without the searches of single assignments.
  Counters outside_counters() const {
    Counters counters = ended_;
    if (all_) all_->add_counts(counters);
    counters[Counter::kAssignments] = searched_;
    return counters;
  }

  void prove_infeasible() {
    const std::string reason = "no assignment of the tasks and goals has a plan";
    merged_.infeasible(reason);
    best_.status = Status::kInfeasible;
    best_.lower_bound = 0;
    best_.stats.texts["reason"] = reason;
    cutoff_margin_ = 0;
  }

  void end_all() {
    all_->add_counts(ended_);
    all_.reset();
  }

  Solution finish() {
    add(outside_counters(), best_.stats.counts);
    auto& texts = best_.stats.texts;
    texts.erase("stopped_by");
    texts.erase("remark");
    if (best_.status != Status::kInfeasible) state_bound(std::max(reported(), best_.lower_bound));
    if (is_over()) return std::move(best_);
    if (limits_.stop_requested()) texts["stopped_by"] = stop_text(limits_.reason());
    texts["remark"] = fmt::format(
        "assignments searched: {}{}; the lower bound holds for all assignments", searched_,
        limits_.stop_requested() ? "" : ", no further one found that could be cheaper");
    return std::move(best_);
  }

  const Instance& instance_;
  const SolveOptions& options_;
  SolveOptions of_one_ = options_;  // for one assignment, which proves nothing for all
  const Limits& limits_;
  MergedObserver& merged_;
  Cost bound_ = 0;      // for all assignments
  Cost certified_ = 0;  // the part of it that the proof log proves
  Solution best_;
  std::unique_ptr<AllAssignmentsSearch> all_;
  bool has_announced_all_ = false;
  Counters ended_;                      // of earlier searches over all assignments
  Cost cutoff_ = kInfiniteCost;         // of all_
  Cost cutoff_margin_ = kInfiniteCost;  // 0: all assignments cannot be searched
  int failures_ = 0;                    // assignments in succession without a cheaper plan
  // Seconds; in deterministic runs, calls. Bounds and plans take turns, and for plans exchanges and
  // assignments.
  double spent_on_bounds_ = 0;
  double spent_on_exchanges_ = 0;
  double spent_on_assignments_ = 0;
  int searched_ = 0;
  ExchangeSearch& exchanges_;
  Cost exchanged_from_ = kInfiniteCost;  // cost of the plan from which exchanges_ continues
};

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
  route_bound.improve(kBoundEffort, part_of(limits, options, kBoundShare));
  const std::chrono::duration<double> spent = limits.now() - start;
  bound = std::max(bound, route_bound.lower_bound());
  merged.note(
      "Searches assignments of tasks and goals; the lower bound holds for all assignments.");
  ExchangeSearch exchanges(instance, distances, assignments.routes(), options.seed);
  return ChoicesRun(instance, options, limits, merged, exchanges)
      .run(assignments, *first, route_bound, bound, spent.count());
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
