// SPDX-License-Identifier: MIT
// Solves instances in which agents choose tasks or destinations.
#pragma once

#include "engine/run_observer.h"
#include "engine/solve.h"

namespace grove::detail {

// Solves an instance with choices, with the contract of solve(): chooses an assignment by insertion
// (assignment/insertion.h) and searches the instance with this assignment. The lower bound holds
// for all assignments (assignment/choice_bounds.h). Precondition: require_choices_fit().
Solution solve_with_choices(const Instance& instance, const SolveOptions& options,
                            const Limits& limits, RunObserver& observer);

// Throws std::invalid_argument with what was expected if solve_with_choices() does not support the
// options: sequences that trees fix, published low levels, start plans, checkpoints and proofs.
void require_choices_fit(const SolveOptions& options);

}  // namespace grove::detail
