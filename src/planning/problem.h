// SPDX-License-Identifier: MIT
// Read-only data shared by all parts of the search.
#pragma once

#include "model/distance_field.h"
#include "model/instance.h"
#include "model/shared_arrays.h"
#include "planning/corridors.h"

namespace grove::detail {

// An instance with its distance fields and its corridors. Must outlive the search. Use it only if
// distances.complete(). Immutable: any thread may read it.
struct Problem {
  // `threads`: number of threads that compute the distances. `known`: distance fields of an earlier
  // problem, of which this object shares those that apply, or nullptr. `arrays`: arrays of
  // array_layout() in memory that is shared with other processes, or nullptr. `the_instance` and
  // `arrays` must outlive this object.
  Problem(const Instance& the_instance, const Limits& limits, int threads = 1,
          const DistanceFields* known = nullptr, const SharedArrays* arrays = nullptr)
      : instance(the_instance),
        distances(the_instance, limits, threads, known, arrays),
        corridors(the_instance.world()) {}

  const Instance& instance;  // owned by the caller
  const DistanceFields distances;
  const Corridors corridors;
};

// Layout of the arrays that processes with the same instance can share: distances, stops by state,
// and sequence tables.
ArrayLayout array_layout(const Instance& instance);

}  // namespace grove::detail
