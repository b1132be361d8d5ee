// SPDX-License-Identifier: MIT
// Constraints of a constraint-tree node on one agent. Only this file and constraint.cpp define
// which agents a constraint concerns and when a path satisfies it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "model/plan.h"

namespace grove::detail {

class Corridors;

// The numbers are written to files and messages. A new kind takes the next number and a row in
// constraint.cpp.
enum class ConstraintKind : std::uint8_t {
  // The agent is not on the place `cell` (resting on it after the finish counts as being there) or,
  // with `from` given, does not move from -> cell, at any time in [begin, end]. For a move this is
  // the time of arrival.
  kVertexOrEdge = 0,
  // The agent does not come to rest for ever on `cell` at `end` or earlier: if it ends there, it
  // arrives there for the last time, by a move, later than `end`. (Target reasoning: Li et al.
  // 2021.) `from` and `begin` are not used.
  kNoRestBy = 1,
  // The agent comes to rest for ever on `cell`, at `end` or earlier. `from` and `begin` are not
  // used.
  kRestBy = 2,
  // The agent does not leave a corridor (corridors.h) for its end `cell` by way of the inner place
  // `from`, arriving at a time in [begin, end], after it entered the corridor from the other end
  // and stayed inside since. Turning round inside and starting inside are not traversals.
  kNoTraversal = 3,
  // Only in certificates: in the order in which the stops are counted, stop number `begin` (from 0)
  // is stop `from`, or is not. They state the sequence class of a tree; nodes have no such
  // constraint.
  kStopIs = 4,
  kStopIsNot = 5,
};

inline constexpr std::size_t kConstraintKinds = 6;

// Name in messages: "bar", "no-rest-by", ...
std::string_view name_of(ConstraintKind kind);
// Name, in statistics and logs, of a split whose second constraint has this kind: "target", ...
std::string_view split_name(ConstraintKind second);
// Returns nullopt if no kind has this number.
std::optional<ConstraintKind> constraint_kind(std::uint8_t number);

// Vertex and edge constraints are those of CBS (Sharon et al. 2015), with time ranges as in Atzmon
// et al. 2020. Times are inclusive.
struct Constraint {
  Cell cell = kNoCell;
  Cell from = kNoCell;
  Time begin = 0;
  Time end = 0;  // kNever: for ever
  ConstraintKind kind = ConstraintKind::kVertexOrEdge;

  bool is_move() const { return kind == ConstraintKind::kVertexOrEdge && from != kNoCell; }
  friend bool operator==(const Constraint&, const Constraint&) = default;
};

// Is the constraint on the order of visits? One path may realize several orders.
inline bool is_about_sequence(const Constraint& c) {
  return c.kind == ConstraintKind::kStopIs || c.kind == ConstraintKind::kStopIsNot;
}

// Does `path` (not empty), including its rest for ever, satisfy `c`? `c` must not be about the
// sequence. O(length).
bool satisfies(const World& world, const Path& path, const Constraint& c,
               const Corridors& corridors);

// A constraint and its agent.
struct AgentConstraint {
  AgentIndex agent = -1;  // -1: no agent is constrained
  Constraint constraint;
  friend bool operator==(const AgentConstraint&, const AgentConstraint&) = default;
};

// Does the constraint of one agent imply constraints on all others? A kRestBy bars all other agents
// from the cell from its end on, because its agent rests there.
inline bool constrains_all_agents(const Constraint& c) {
  return c.kind == ConstraintKind::kRestBy;
}

// The constraint that `added`, a constraint of a constraint-tree node, implies for `agent`. Returns
// nullopt if there is none.
std::optional<Constraint> constraint_on(AgentIndex agent, const AgentConstraint& added);

// Calls visit(agent, constraint) for each of `agents` for which `added` implies a constraint.
// `agents` must contain added.agent.
template <class Agents, class Visit>
void for_each_implied_constraint(const AgentConstraint& added, const Agents& agents, Visit visit) {
  if (added.agent < 0) return;
  if (!constrains_all_agents(added.constraint)) return visit(added.agent, added.constraint);
  for (const AgentIndex agent : agents) visit(agent, *constraint_on(agent, added));
}

}  // namespace grove::detail
