// SPDX-License-Identifier: MIT
#include "tests/support/satisfies.h"

#include <algorithm>
#include <stdexcept>

namespace grove::detail::testing {
namespace {

Cell at(const Path& path, Time time) {
  return time < static_cast<Time>(path.size()) ? path[time] : path.back();
}

bool is_inner(const World& grid, Cell cell) {
  return grid.neighbors(cell).size() == 2;
}

bool keeps_off(const Path& path, const Constraint& bar) {
  // Beyond its end the path does not change, so one step of rest represents all later ones.
  const Time last = std::max(static_cast<Time>(path.size()), bar.begin);
  for (Time t = std::max(bar.begin, 0); t <= std::min(bar.end, last); ++t) {
    if (at(path, t) != bar.cell) continue;
    if (!bar.is_move() || (t > 0 && at(path, t - 1) == bar.from)) return false;
  }
  return true;
}

// Returns the time of the last move, by which the agent reaches the cell where it rests; 0 if it
// never moves.
Time last_arrival(const Path& path) {
  auto t = static_cast<Time>(path.size()) - 1;
  while (t > 0 && path[t - 1] == path[t]) --t;
  return t;
}

// Returns the entrance by which the agent entered the corridor in which it is at time t, or no
// entrance if it has been inside since time 0.
Mouth entered_by(const World& grid, const Path& path, Time t) {
  while (t >= 0 && is_inner(grid, path[t])) --t;
  return t < 0 ? Mouth{} : Mouth{path[t], path[t + 1]};
}

bool traverses(const World& grid, const Path& path, const Constraint& c) {
  const Time last = std::min(c.end, static_cast<Time>(path.size()) - 1);
  for (Time t = std::max(c.begin, 1); t <= last; ++t) {
    if (path[t] != c.cell || path[t - 1] != c.from) continue;
    const Mouth mouth = entered_by(grid, path, t - 1);
    if (mouth != Mouth{} && mouth != Mouth{c.cell, c.from}) return true;
  }
  return false;
}

}  // namespace

bool is_mouth(const World& grid, Cell end, Cell inner) {
  return is_inner(grid, inner) && !is_inner(grid, end) &&
         std::ranges::count(grid.neighbors(end), inner) > 0;
}

bool satisfies(const World& grid, const Path& walked, const Constraint& c) {
  Path path;  // as places, because constraints refer to places only
  for (const State state : walked) path.push_back(grid.place(state));
  const Time rest = last_arrival(path);
  switch (c.kind) {
    case ConstraintKind::kVertexOrEdge:
      return keeps_off(path, c);
    case ConstraintKind::kNoRestBy:
      return path.back() != c.cell || rest > c.end;
    case ConstraintKind::kRestBy:
      return path.back() == c.cell && rest <= c.end;
    case ConstraintKind::kNoTraversal:
      return !traverses(grid, path, c);
    case ConstraintKind::kStopIs:
    case ConstraintKind::kStopIsNot:
      break;  // cannot be decided from the path alone
  }
  throw std::invalid_argument("a sequence constraint does not apply to paths");
}

}  // namespace grove::detail::testing
