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

// The numbers of the kinds are part of file formats and of messages between ranks. A new kind takes
// the next number and a row in constraint.cpp.
enum class ConstraintKind : std::uint8_t {
  // Without `from`: the agent is not on the place `cell` at any time in [begin, end]; resting there
  // after the finish counts. With `from`: the agent makes no move from `from` to `cell` that
  // arrives at a time in [begin, end].
  kVertexOrEdge = 0,
  // The agent does not come to rest forever on `cell` at `end` or earlier: if it rests there, it
  // makes its last move to the place later than `end`. (Target reasoning: Li et al. 2021.) `from`
  // and `begin` are not used.
  kNoRestBy = 1,
  // The agent comes to rest forever on `cell`: it makes its last move to the place at `end` or
  // earlier, and may turn or execute tasks there afterwards. `from` and `begin` are not used.
  kRestBy = 2,
  // The agent does not traverse a corridor (corridors.h) such that it arrives on the end `cell`,
  // from the inner place `from`, at a time in [begin, end]. A traversal enters at the other end and
  // stays inside in between. An agent that starts inside, or leaves where it entered, makes no
  // traversal.
  kNoTraversal = 3,
  // Only in certificates: in the sequence of counted stops, position `begin` (from 0) holds stop
  // `from` (kStopIs), or does not (kStopIsNot). These constraints state the sequence class of a
  // tree. No constraint-tree node contains them.
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

// Constraint on one agent; ConstraintKind defines its meaning. Vertex and edge constraints are
// those of CBS (Sharon et al. 2015), with time ranges as in Atzmon et al. 2020. Times are
// inclusive.
struct Constraint {
  Cell cell = kNoCell;
  Cell from = kNoCell;
  Time begin = 0;
  Time end = 0;  // kNever: forever
  ConstraintKind kind = ConstraintKind::kVertexOrEdge;

  bool is_move() const { return kind == ConstraintKind::kVertexOrEdge && from != kNoCell; }
  friend bool operator==(const Constraint&, const Constraint&) = default;
};

// Is the constraint about the order of visits? A path does not decide such a constraint, because it
// can realize several orders.
inline bool is_about_sequence(const Constraint& c) {
  return c.kind == ConstraintKind::kStopIs || c.kind == ConstraintKind::kStopIsNot;
}

// Does `path` (not empty), including its final rest, satisfy `c`? Throws std::invalid_argument if
// `c` is about the sequence. O(path length).
bool satisfies(const World& world, const Path& path, const Constraint& c,
               const Corridors& corridors);

// Does an agent violate `c` by its presence on `place` at `time`? `is_last`: `time` is its last
// arrival, so that it stays forever. A path satisfies a constraint on places (kVertexOrEdge without
// `from`), kNoRestBy or kRestBy exactly if none of its presences violates the constraint. False for
// the other constraints, which are about more than one time.
bool violates(const Constraint& c, Place place, Time time, bool is_last);

// A constraint and the agent that it constrains.
struct AgentConstraint {
  AgentIndex agent = -1;  // -1: no agent is constrained
  Constraint constraint;
  friend bool operator==(const AgentConstraint&, const AgentConstraint&) = default;
};

// Does this constraint on one agent imply constraints on all other agents? kRestBy does: it bars
// the other agents from `cell` from time `end` on, because its own agent rests there.
inline bool constrains_all_agents(const Constraint& c) {
  return c.kind == ConstraintKind::kRestBy;
}

// Returns the constraint that `added`, a constraint of a constraint-tree node, implies for `agent`.
// Returns nullopt if it implies none.
std::optional<Constraint> constraint_on(AgentIndex agent, const AgentConstraint& added);

// Calls visit(agent, constraint) for each agent of `agents` on which `added` implies a constraint.
// `agents` must contain added.agent.
template <class Agents, class Visit>
void for_each_implied_constraint(const AgentConstraint& added, const Agents& agents, Visit visit) {
  if (added.agent < 0) return;
  if (!constrains_all_agents(added.constraint)) return visit(added.agent, added.constraint);
  for (const AgentIndex agent : agents) visit(agent, *constraint_on(agent, added));
}

}  // namespace grove::detail
