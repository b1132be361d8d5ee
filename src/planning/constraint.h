// SPDX-License-Identifier: MIT
// What a constraint-tree node demands of one agent: whom a constraint concerns, and what a path
// must do to obey it, are said here and in constraint.cpp once for all.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "model/plan.h"

namespace grove::detail {

class Corridors;

// The numbers are those of files and messages: a new kind takes the next one and a row in
// constraint.cpp.
enum class ConstraintKind : std::uint8_t {
  // Not on the place `cell` (resting on it after the finish counts as being there), or, with `from`
  // given, not moving from -> cell, at any time in [begin, end]; for a move the time of arrival.
  kVertexOrEdge = 0,
  // Does not come to rest for ever on `cell` at `end` or earlier: if the agent ends there, it
  // arrives there for the last time, by a move, later than `end`. (Target reasoning: Li et al.
  // 2021.) `from` and `begin` are not used.
  kNoRestBy = 1,
  // Comes to rest for ever on `cell`, at `end` or earlier. `from` and `begin` are not used.
  kRestBy = 2,
  // Does not leave a chain (chains.h) for its end `cell` by way of the inner cell `from`, arriving
  // at a time in [begin, end], after having entered it from its other end and stayed inside since.
  // Turning round inside, and starting inside, are no traversals.
  kNoTraversal = 3,
  // Of the stops in the order in which they are counted, number `begin` (from 0) is stop `from`, on
  // `cell`, or is not. Such constraints make a sequence class (sequence_constraints.h).
  kStopIs = 4,
  kStopIsNot = 5,
};

inline constexpr std::size_t kConstraintKinds = 6;

// For messages: "bar", "no-rest-by" ...
std::string_view name_of(ConstraintKind kind);
// None: no kind has this number.
std::optional<ConstraintKind> constraint_kind(std::uint8_t number);

// Bars are those of CBS (Sharon et al. 2015), ranges as in Atzmon et al. 2020. Times are inclusive.
struct Constraint {
  Cell cell = kNoCell;
  Cell from = kNoCell;
  Time begin = 0;
  Time end = 0;  // kNever: for ever
  ConstraintKind kind = ConstraintKind::kVertexOrEdge;

  bool is_move() const { return kind == ConstraintKind::kVertexOrEdge && from != kNoCell; }
  friend bool operator==(const Constraint&, const Constraint&) = default;
};

// Such constraints speak of the order of visits, of which a path alone may realize several.
inline bool is_about_sequence(const Constraint& c) {
  return c.kind == ConstraintKind::kStopIs || c.kind == ConstraintKind::kStopIsNot;
}

// Does `path` (not empty), its rest for ever included, do what `c`, which is not about the
// sequence, demands? O(length).
bool satisfies(const World& world, const Path& path, const Constraint& c,
               const Corridors& corridors);

// One agent and what it is forbidden.
struct AgentConstraint {
  AgentIndex agent = -1;  // -1: nobody is forbidden anything
  Constraint constraint;
  friend bool operator==(const AgentConstraint&, const AgentConstraint&) = default;
};

// Does it demand something of every agent? A kRestBy of one bars all others from the cell from its
// end on: that is where the one rests.
inline bool constrains_all_agents(const Constraint& c) {
  return c.kind == ConstraintKind::kRestBy;
}

// What `added`, a constraint of a constraint-tree node, demands of `agent`; none if nothing.
std::optional<Constraint> constraint_on(AgentIndex agent, const AgentConstraint& added);

// Calls visit(agent, demand) for each of `agents`, which hold added.agent, of whom `added` demands
// something.
template <class Agents, class Visit>
void for_each_implied_constraint(const AgentConstraint& added, const Agents& agents, Visit visit) {
  if (added.agent < 0) return;
  if (!constrains_all_agents(added.constraint)) return visit(added.agent, added.constraint);
  for (const AgentIndex agent : agents) visit(agent, *constraint_on(agent, added));
}

}  // namespace grove::detail
