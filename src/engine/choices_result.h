// SPDX-License-Identifier: MIT
// The best plan and lower bound of a run on an instance with choices.
#pragma once

#include <optional>
#include <string>

#include "assignment/assignment.h"
#include "assignment/route_bound.h"
#include "engine/all_assignments.h"
#include "engine/component_id.h"
#include "engine/merged_observer.h"
#include "engine/solve.h"
#include "model/counters.h"
#include "model/limits.h"

namespace grove::detail {

// Holds the result so far, reports it, and searches parts of the instance for better plans. One
// thread at a time.
class ChoicesResult {
 public:
  // `bound`: a lower bound for all assignments. The other arguments must outlive this object.
  ChoicesResult(const Instance& instance, const SolveOptions& options, const Limits& limits,
                MergedObserver& merged, Cost bound);

  std::optional<Cost> incumbent() const;
  Cost cost() const { return incumbent().value_or(kInfiniteCost); }
  const std::optional<Plan>& plan() const { return best_.plan; }
  Cost bound() const { return bound_; }  // for all assignments
  // The lower bound that decides when the run ends: with a proof, the certified one.
  Cost reported() const { return options_.proof ? certified_ : bound_; }
  // True if the plan is within omega, or if it is proven that there is none.
  bool is_final() const;

  // Searches the plans with one assignment, which takes `share` of the time that is left. Returns a
  // lower bound for plans of with_assignment(instance, assignment).
  Cost search(const Assignment& assignment, double share);
  // Searches the plans that cost less than the best one and make the choices that are left in
  // `choices`, by a core-guided search with about `effort`. Returns a lower bound for them.
  Cost search(RouteBound& choices, std::int64_t effort);

  void use_plan(Plan plan, PlanSource source);
  // States that all plans cost at least `proven`. is_certified: the proof log proves it.
  void raise_bound(Cost proven, ComponentId source, bool is_certified = false);
  // The same, and `plan` is cheaper than the best one so far.
  void use_plan_and_bound(Plan plan, PlanSource source, Cost proven, ComponentId bound_source);
  void prove_infeasible();
  void report_progress() { report(RunEvent::kProgress); }

  // The current search over all assignments, whose counters belong to the result.
  void set_running(const AllAssignmentsSearch* running) { running_ = running; }
  void add_counts_of(const AllAssignmentsSearch& ended) { ended.add_counts(ended_); }

  // The result of the run.
  Solution finish();

 private:
  void set_bound(Cost proven, ComponentId source, bool is_certified);
  void state(Cost bound);
  Progress progress() const { return {.lower_bound = reported(), .incumbent = incumbent()}; }
  void report(RunEvent event);
  Counters outside_counters() const;

  const Instance& instance_;
  const SolveOptions& options_;
  SolveOptions of_part_;  // without the proof log, for searches of a part of the assignments
  const Limits& limits_;
  MergedObserver& merged_;
  Solution best_;
  Cost bound_;
  Cost certified_ = 0;  // the lower bound that the proof log proves; at most bound_
  int searched_ = 0;    // assignments
  const AllAssignmentsSearch* running_ = nullptr;
  Counters ended_;  // of earlier searches over all assignments
};

}  // namespace grove::detail
