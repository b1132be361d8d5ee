// SPDX-License-Identifier: MIT
// Searches a restriction of an instance, of which every plan is a plan of the instance.
#pragma once

#include <functional>
#include <string>

#include "engine/merged_observer.h"
#include "engine/solve.h"

namespace grove::detail {

// A restriction of an instance, and what is known about the whole instance.
struct Restriction {
  Instance instance;
  std::function<Plan(const Plan&)> to_whole;  // converts a plan to one of the whole instance
  Cost bound = 0;                             // proven: no plan of the whole instance costs less
  // The search stops when it has proven that no plan of the restriction costs less than this.
  Cost cutoff = kInfiniteCost;
  // For messages: the plans of the restriction, such as "plans that end on the chosen tasks", and a
  // sentence for the case that there are none.
  std::string plans;
  std::string has_no_plan;
};

// Searches the restriction. The result refers to the whole instance: its lower bound is
// `restriction.bound`, because the bound of the search holds only for the restriction. The search
// ends when its plan is within omega of its own bound, so the status can be kFeasible; a remark
// then says so. If the restriction has no plan, the status is kUnknown, also with a remark.
Solution solve_restriction(const Restriction& restriction, const SolveOptions& options,
                           const Limits& limits, MergedObserver& merged);
// The same with another search of `restriction.instance`, to within `omega` and within `limits`.
Solution solve_restriction(const Restriction& restriction, Omega omega, const Limits& limits,
                           MergedObserver& merged,
                           const std::function<Solution(RunObserver&)>& search);

// Did a limit stop the run with this result?
bool was_stopped(const Solution& solution);
// The result of a run that a limit stopped before it had a plan or a bound.
Solution stopped_solution(const SolveOptions& options, const Limits& limits);

}  // namespace grove::detail
