// SPDX-License-Identifier: MIT
// Solves instances in which agents choose tasks or destinations.
#pragma once

#include "engine/run_observer.h"
#include "engine/solve.h"

namespace grove::detail {

// Solves an instance with choices, with the contract of solve(): searches one assignment after the
// other (assignment/assignment_search.h), each as an instance without choices. The lower bound holds
// for all assignments (assignment/choice_bounds.h). Ends without a proof when no further assignment
// is found or many have led to no cheaper plan. Precondition: require_choices_fit().
Solution solve_with_choices(const Instance& instance, const SolveOptions& options,
                            const Limits& limits, RunObserver& observer);

// Throws InstanceError if the instance has choices and the options are for a part of Grove that
// does not support them: policy fixed, start plans, checkpoints or proofs.
void require_choices_fit(const Instance& instance, const SolveOptions& options);

}  // namespace grove::detail
