// SPDX-License-Identifier: MIT
// What the constraints mean, said of a path alone.
#pragma once

#include <string>

#include "model/plan.h"
#include "planning/constraint.h"

namespace grove::detail::testing {

// Does `path`, its rest for ever included, obey `constraint`?
bool satisfies(const World& grid, const Path& path, const Constraint& constraint);

// A way into a chain: from an end to the inner cell next to it.
struct Mouth {
  Cell end = kNoCell;
  Cell inner = kNoCell;
  friend bool operator==(const Mouth&, const Mouth&) = default;
};

// Is this a move from an end of a chain into it?
bool is_mouth(const World& grid, Cell end, Cell inner);

}  // namespace grove::detail::testing
