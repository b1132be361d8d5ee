// SPDX-License-Identifier: MIT
// What every part of the search reads and none changes.
#pragma once

#include "grove/baselines/baseline_search.h"
#include "grove/model/distance_field.h"
#include "grove/model/instance.h"
#include "grove/planning/chains.h"

namespace grove {

// An instance with its distance fields and its corridors, and what plans its agents one by one.
// Immutable, shared by all threads; outlives the search. Use it only if distances.complete().
struct Problem {
  Problem(const Instance& the_instance, const Limits& limits,
          LowLevel the_low_level = LowLevel::kOwn)
      : instance(the_instance),
        distances(the_instance, limits),
        chains(the_instance.grid()),
        low_level(the_low_level) {}

  const Instance& instance;  // owned by the caller
  const DistanceFields distances;
  const Chains chains;
  const LowLevel low_level;
};

}  // namespace grove
