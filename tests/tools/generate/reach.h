// SPDX-License-Identifier: MIT
// Reachability for tests of generators.
#pragma once

#include <set>
#include <vector>

#include "model/world.h"

namespace grove::detail {

// Returns the places that are reachable from `place` along the edges `next`.
template <class Next>
std::set<Place> closure_of(Place place, Next next) {
  std::set<Place> seen{place};
  std::vector<Place> stack{place};
  while (!stack.empty()) {
    const Place here = stack.back();
    stack.pop_back();
    for (const Place to : next(here))
      if (seen.insert(to).second) stack.push_back(to);
  }
  return seen;
}

inline std::set<Place> reached_from(const World& world, Place place) {
  return closure_of(place, [&](Place here) { return world.moves(here); });
}

inline std::set<Place> reaching(const World& world, Place place) {
  return closure_of(place, [&](Place here) { return world.moves_to(here); });
}

}  // namespace grove::detail
