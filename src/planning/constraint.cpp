// SPDX-License-Identifier: MIT
#include "planning/constraint.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "model/assert.h"
#include "planning/corridors.h"

namespace grove::detail {
namespace {

struct Named {
  ConstraintKind kind;
  std::string_view name;
  std::string_view split;
};

constexpr std::array<Named, kConstraintKinds> kNames = {{
    {ConstraintKind::kVertexOrEdge, "bar", "vertex-edge"},
    {ConstraintKind::kNoRestBy, "no-rest-by", "cost"},
    {ConstraintKind::kRestBy, "rest-by", "target"},
    {ConstraintKind::kNoTraversal, "no-traversal", "corridor"},
    {ConstraintKind::kStopIs, "stop-is", "sequence"},
    {ConstraintKind::kStopIsNot, "stop-is-not", "sequence"},
}};

// One time step after the end of the path represents all later ones, because the agent rests.
bool avoids(const World& world, const Path& path, const Constraint& bar) {
  const Time last = std::min(bar.end, std::max(static_cast<Time>(path.size()), bar.begin));
  for (Time t = std::max(bar.begin, 0); t <= last; ++t) {
    if (place_at(world, path, t) != bar.cell) continue;
    if (!bar.is_move() || (t > 0 && place_at(world, path, t - 1) == bar.from)) return false;
  }
  return true;
}

bool rests_by(const World& world, const Path& path, const Constraint& c) {
  return world.place(path.back()) == c.cell && last_arrival(world, path) <= c.end;
}

// Does the move to path[arrival], which leaves a corridor, complete a traversal?
bool ends_traversal(const World& world, const Path& path, Time arrival,
                    const Corridors& corridors) {
  const auto place = [&](Time t) { return world.place(path[t]); };
  const int corridor = corridors.corridor_of(place(arrival - 1));
  Time before = arrival - 1;  // after the loop: the last time outside
  while (before >= 0 && corridors.corridor_of(place(before)) == corridor) --before;
  if (before < 0) return false;
  return place(before) != place(arrival) || place(before + 1) != place(arrival - 1);
}

bool traverses(const World& world, const Path& path, const Constraint& c,
               const Corridors& corridors) {
  const Time last = std::min(c.end, static_cast<Time>(path.size()) - 1);
  for (Time t = std::max(c.begin, 1); t <= last; ++t)
    if (world.place(path[t]) == c.cell && world.place(path[t - 1]) == c.from &&
        ends_traversal(world, path, t, corridors))
      return true;
  return false;
}

}  // namespace

std::string_view name_of(ConstraintKind kind) {
  return std::ranges::find(kNames, kind, &Named::kind)->name;
}

std::string_view split_name(ConstraintKind second) {
  return std::ranges::find(kNames, second, &Named::kind)->split;
}

std::optional<ConstraintKind> constraint_kind(std::uint8_t number) {
  const auto kind = static_cast<ConstraintKind>(number);
  const bool known = std::ranges::find(kNames, kind, &Named::kind) != kNames.end();
  return known ? std::optional(kind) : std::nullopt;
}

bool satisfies(const World& world, const Path& path, const Constraint& c,
               const Corridors& corridors) {
  GROVE_ASSERT(!path.empty(), "a path is not empty");
  switch (c.kind) {
    case ConstraintKind::kVertexOrEdge:
      return avoids(world, path, c);
    case ConstraintKind::kNoRestBy:
      return !rests_by(world, path, c);
    case ConstraintKind::kRestBy:
      return rests_by(world, path, c);
    case ConstraintKind::kNoTraversal:
      return !traverses(world, path, c, corridors);
    case ConstraintKind::kStopIs:
    case ConstraintKind::kStopIsNot:
      break;
  }
  throw std::invalid_argument("a sequence constraint does not apply to paths");
}

bool violates(const Constraint& c, Place place, Time time, bool is_last) {
  switch (c.kind) {
    case ConstraintKind::kVertexOrEdge:
      return !c.is_move() && place == c.cell && time <= c.end &&
             (is_last ? c.begin <= c.end : c.begin <= time);
    case ConstraintKind::kNoRestBy:
      return is_last && place == c.cell && time <= c.end;
    case ConstraintKind::kRestBy:
      return is_last && (place != c.cell || time > c.end);
    default:
      return false;
  }
}

std::optional<Constraint> constraint_on(AgentIndex agent, const AgentConstraint& added) {
  const Constraint& c = added.constraint;
  if (agent == added.agent) return c;
  if (added.agent < 0 || !constrains_all_agents(c)) return std::nullopt;
  return Constraint{c.cell, kNoCell, c.end, kNever};
}

}  // namespace grove::detail
