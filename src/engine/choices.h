// SPDX-License-Identifier: MIT
// Solves instances in which agents choose tasks or destinations.
#pragma once

#include "engine/run_observer.h"
#include "engine/solve.h"

namespace grove::detail {

// Solves an instance with choices, with the contract of solve(). With policy fixed, there is one
// tree per joint assignment with sequences (search/route_forest.h). Otherwise alternates between
// single assignments (assignment/assignment_search.h), each as an instance without choices,
// exchanges between the agents of the best plan (assignment/exchange_search.h), and a search over
// all assignments (engine/all_assignments.h). The lower bound holds for all
// assignments. Ends without a proof if the search over all assignments cannot continue and many
// further assignments have led to no cheaper plan. Precondition: require_choices_fit().
Solution solve_with_choices(const Instance& instance, const SolveOptions& options,
                            const Limits& limits, RunObserver& observer);

// Throws InstanceError if the instance has choices and the options are for a part of Grove that
// does not support them: start plans or checkpoints; policy fixed with the choices that
// require_joint_routes() refuses; or if options.proof is set, policy fixed or choices that
// certificates do not cover.
void require_choices_fit(const Instance& instance, const SolveOptions& options);

// Throws InstanceError if the instance has a choice that certificates do not cover.
void require_certified_choices(const Instance& instance);

}  // namespace grove::detail
