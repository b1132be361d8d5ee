// SPDX-License-Identifier: MIT
// What every part of the search reads and none changes.
#pragma once

#include "model/distance_field.h"
#include "model/instance.h"
#include "model/shared_arrays.h"
#include "planning/corridors.h"

namespace grove::detail {

// An instance with its distance fields and its corridors. Immutable, shared by all threads;
// outlives the search. Use it only if distances.complete().
struct Problem {
  // `threads`: to make it on. `known`: distances of an earlier one, to share; null: none. `arrays`:
  // of array_layout(), in memory shared with other processes; null: none. They must outlive this.
  Problem(const Instance& the_instance, const Limits& limits, int threads = 1,
          const DistanceFields* known = nullptr, const SharedArrays* arrays = nullptr)
      : instance(the_instance),
        distances(the_instance, limits, threads, known, arrays),
        corridors(the_instance.world()) {}

  const Instance& instance;  // owned by the caller
  const DistanceFields distances;
  const Corridors corridors;
};

// The arrays that processes which search the same instance can share: distances, and what agents
// are told of their stops and orders.
ArrayLayout array_layout(const Instance& instance);

}  // namespace grove::detail
