// SPDX-License-Identifier: MIT
// CTS-CBS-B and CTS-CBS-C for MG-MAPF (paper, section V-B). Each function has the contract of
// solve(), and requires an instance with at least one agent without a destination.
#pragma once

#include "engine/run_observer.h"
#include "engine/solve.h"

namespace grove::detail {

// CTS-CBS-B: one task of each agent without a destination becomes its destination.
Solution solve_with_destinations(const Instance& instance, const SolveOptions& options,
                                 const Limits& limits, RunObserver& observer);

// CTS-CBS-C: runs A (solve() on the instance itself) and, if A is stopped, B in the rest of the
// time. A is stopped after two thirds of the time, or earlier if the memory limit is reached or,
// with omega = inf, if its first tree holds no plan.
Solution solve_with_destinations_last(const Instance& instance, const SolveOptions& options,
                                      const Limits& limits, RunObserver& observer);

// CTS-CBS-C in the paper's alternative order: B for at most two thirds of the time, then A with B's
// plan as its first incumbent.
Solution solve_with_destinations_first(const Instance& instance, const SolveOptions& options,
                                       const Limits& limits, RunObserver& observer);

}  // namespace grove::detail
