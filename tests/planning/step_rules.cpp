// SPDX-License-Identifier: MIT
#include "tests/planning/step_rules.h"

#include <algorithm>

namespace grove::detail::testing {
namespace {

bool covers(const Constraint& c, Time time) {
  return c.begin <= time && time <= c.end;
}

}  // namespace

bool StepRules::barred(Cell cell, Time time) const {
  return std::ranges::any_of(constraints_, [&](const Constraint& c) {
    return c.kind == ConstraintKind::kVertexOrEdge && !c.is_move() && c.cell == cell &&
           covers(c, time);
  });
}

bool StepRules::move_barred(Cell from, Cell to, Mouth mouth, Time time) const {
  return std::ranges::any_of(constraints_, [&](const Constraint& c) {
    if (c.from != from || c.cell != to || !covers(c, time)) return false;
    const bool traverses = mouth != Mouth{} && mouth != Mouth{to, from};
    return c.is_move() || (c.kind == ConstraintKind::kNoTraversal && traverses);
  });
}

Mouth StepRules::mouth_after(Cell from, Cell to, Mouth mouth) const {
  if (is_mouth(grid_, from, to)) return {from, to};
  return is_mouth(grid_, to, from) ? Mouth{} : mouth;
}

bool StepRules::is_late(Cell cell, Time time) const {
  return std::ranges::none_of(constraints_, [&](const Constraint& c) {
    return c.kind == ConstraintKind::kNoRestBy && c.cell == cell && time <= c.end;
  });
}

bool StepRules::may_rest(Cell cell, Time time) const {
  return std::ranges::none_of(constraints_, [&](const Constraint& c) {
    if (c.kind == ConstraintKind::kRestBy) return c.cell != cell || c.end < time;
    return c.kind == ConstraintKind::kVertexOrEdge && !c.is_move() && c.cell == cell &&
           c.begin <= c.end && c.end >= time;
  });
}

Time StepRules::last_change() const {
  Time last = 0;
  for (const Constraint& c : constraints_)
    last = std::max({last, c.begin + 1, c.end >= kNever ? 0 : c.end + 1});
  return last;
}

}  // namespace grove::detail::testing
