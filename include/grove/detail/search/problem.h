// SPDX-License-Identifier: MIT
// What every part of the search reads and none changes.
#pragma once

#include "grove/detail/model/distance_field.h"
#include "grove/detail/model/instance.h"
#include "grove/detail/planning/chains.h"

namespace grove::detail {

// An instance with its distance fields and its corridors. Immutable, shared by all threads;
// outlives the search. Use it only if distances.complete().
struct Problem {
  // `threads`: to make it on. `known`: distances of an earlier one, to share; null: none.
  Problem(const Instance& the_instance, const Limits& limits, int threads = 1,
          const DistanceFields* known = nullptr)
      : instance(the_instance),
        distances(the_instance, limits, threads, known),
        chains(the_instance.world()) {}

  const Instance& instance;  // owned by the caller
  const DistanceFields distances;
  const Chains chains;
};

}  // namespace grove::detail
