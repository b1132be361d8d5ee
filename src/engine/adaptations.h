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

// CTS-CBS-C: runs A (solve() on the instance itself) and, if A is stopped before a limit of the
// whole run is reached, B in the rest of the time. A is stopped after two thirds of the time, or
// earlier if the memory limit is reached or, with omega = inf, if its first tree holds no plan.
Solution solve_with_destinations_last(const Instance& instance, const SolveOptions& options,
                                      const Limits& limits, RunObserver& observer);

// CTS-CBS-C in the paper's alternative order: B for at most two thirds of the time, then A with B's
// plan, if any, as its first incumbent. A is not run if B's plan is within omega of the reported
// bound, or if B proves that no plan exists.
Solution solve_with_destinations_first(const Instance& instance, const SolveOptions& options,
                                       const Limits& limits, RunObserver& observer);

// Merges the results of two searches, for CTS-CBS-C. The end of the second search is reported as
// the end of the run, with two exceptions: if both results together are within omega, no limit is
// reported; and if the second search proved only that its chosen destinations admit no plan, the
// limit that stopped the first search is reported.
Solution merged_result(const Solution& first, Solution second);

}  // namespace grove::detail
