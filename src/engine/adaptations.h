// SPDX-License-Identifier: MIT
// CTS-CBS-B and CTS-CBS-C for MG-MAPF (paper, section V-B). All have the contract of solve(). The
// instance must have an agent without a destination.
#pragma once

#include "engine/run_observer.h"
#include "engine/solve.h"

namespace grove::detail {

// B: one task of each agent without a destination becomes its destination.
Solution solve_with_destinations(const Instance& instance, const SolveOptions& options,
                                 const Limits& limits, RunObserver& observer);

// C: A, and if A is stopped, B in the rest of the time. A is stopped after two thirds of the time,
// or earlier because there is no memory left or, with omega = inf, because its first tree holds no
// plan.
Solution solve_with_destinations_last(const Instance& instance, const SolveOptions& options,
                                      const Limits& limits, RunObserver& observer);

// C, the paper's alternative: B for at most two thirds of the time, then A with B's plan as its
// first incumbent.
Solution solve_with_destinations_first(const Instance& instance, const SolveOptions& options,
                                       const Limits& limits, RunObserver& observer);

}  // namespace grove::detail
