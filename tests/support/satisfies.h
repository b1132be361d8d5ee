// SPDX-License-Identifier: MIT
// Reference implementation of constraints, evaluated on a complete path.
#pragma once

#include <string>

#include "model/plan.h"
#include "planning/constraint.h"

namespace grove::detail::testing {

// Returns whether `path`, including its rest forever, satisfies `constraint`. Throws
// std::invalid_argument if it is a constraint on the sequence.
bool satisfies(const World& grid, const Path& path, const Constraint& constraint);

// Entrance of a corridor: the move from `end`, outside, to the adjacent inner cell. Default: no
// entrance.
struct Mouth {
  Cell end = kNoCell;
  Cell inner = kNoCell;
  friend bool operator==(const Mouth&, const Mouth&) = default;
};

// Returns whether the move from `end` to `inner` is an entrance of a corridor.
bool is_mouth(const World& grid, Cell end, Cell inner);

}  // namespace grove::detail::testing
