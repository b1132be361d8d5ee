// SPDX-License-Identifier: MIT
// Rules that the constraints impose on an agent that moves step by step, for the reference
// searches.
#pragma once

#include <vector>

#include "planning/constraint.h"
#include "tests/support/satisfies.h"

namespace grove::detail::testing {

// Evaluates constraints in the state of an agent. In addition to cell and time, the caller's state
// must hold the mouth by which the agent entered its corridor (none if it is in no corridor or has
// been inside since time 0), and whether it arrived late at its cell (is_late()).
class StepRules {
 public:
  // `grid` and `constraints` must outlive this object.
  StepRules(const World& grid, const std::vector<Constraint>& constraints)
      : grid_(grid), constraints_(constraints) {}

  bool barred(Cell cell, Time time) const;
  // Returns whether the move that arrives at `time` is barred to an agent that entered by `mouth`.
  bool move_barred(Cell from, Cell to, Mouth mouth, Time time) const;
  Mouth mouth_after(Cell from, Cell to, Mouth mouth) const;
  // Returns whether an arrival at `time` is later than all times by which the agent may not rest on
  // `cell`.
  bool is_late(Cell cell, Time time) const;
  // Returns whether an agent that arrived late may rest on `cell` from `time` on.
  bool may_rest(Cell cell, Time time) const;
  // Time from which the rules no longer change.
  Time last_change() const;

 private:
  const World& grid_;
  const std::vector<Constraint>& constraints_;
};

}  // namespace grove::detail::testing
