// SPDX-License-Identifier: MIT
// Reference implementation of the constraints on a path.
#pragma once

#include <string>

#include "model/plan.h"
#include "planning/constraint.h"

namespace grove::detail::testing {

// Does `path`, including its rest for ever, satisfy `constraint`? Throws std::invalid_argument for
// a constraint on the sequence.
bool satisfies(const World& grid, const Path& path, const Constraint& constraint);

// Entrance of a corridor: the move from an end to the inner cell next to it. Default: no entrance.
struct Mouth {
  Cell end = kNoCell;
  Cell inner = kNoCell;
  friend bool operator==(const Mouth&, const Mouth&) = default;
};

// Is the move from `end` to `inner` an entrance of a corridor?
bool is_mouth(const World& grid, Cell end, Cell inner);

}  // namespace grove::detail::testing
