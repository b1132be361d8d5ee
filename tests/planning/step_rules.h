// SPDX-License-Identifier: MIT
// What constraints say to an agent that goes step by step: for the references.
#pragma once

#include <vector>

#include "planning/constraint.h"
#include "tests/support/satisfies.h"

namespace grove::detail::testing {

// Besides where it is and when, an agent must know by which mouth it came into the chain it is in
// (none: not in one, or inside since time 0), and whether it came to where it is late.
class StepRules {
 public:
  // Both must outlive this.
  StepRules(const World& grid, const std::vector<Constraint>& constraints)
      : grid_(grid), constraints_(constraints) {}

  bool barred(Cell cell, Time time) const;
  // The move from -> to that arrives at `time`, by an agent that came in by `mouth`.
  bool move_barred(Cell from, Cell to, Mouth mouth, Time time) const;
  Mouth mouth_after(Cell from, Cell to, Mouth mouth) const;
  // Who comes to `cell` at `time` is later than all times by which it may not have come to rest.
  bool is_late(Cell cell, Time time) const;
  // May an agent that came late rest here from `time` on?
  bool may_rest(Cell cell, Time time) const;
  // From here on nothing changes any more.
  Time last_change() const;

 private:
  const World& grid_;
  const std::vector<Constraint>& constraints_;
};

}  // namespace grove::detail::testing
