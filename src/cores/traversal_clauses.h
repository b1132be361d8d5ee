// SPDX-License-Identifier: MIT
// Clauses that detect the traversals of a corridor in one direction by one agent.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "cores/presence.h"
#include "cores/sat_solver.h"
#include "planning/constraint.h"
#include "planning/corridors.h"

namespace grove::detail {

// The traversals that leave a corridor by one inner place for its end. Each arrival at the end of a
// traversal has a literal that is true in every assignment whose presences contain the traversal.
// One thread at a time.
class TraversalClauses {
 public:
  // `c`: a constraint of kind kNoTraversal. All arguments but `c` must outlive this object.
  TraversalClauses(SatSolver& solver, AgentIndex agent, const Corridors& corridors,
                   const Constraint& c);

  bool is_about(const Constraint& c) const { return c.cell == exit_ && c.from == last_inner_; }
  // Adds the clauses of one more presence, or of its new literal. `presences` holds it and the
  // presences added before.
  void add(const Presence& presence, Literal literal, const PresenceLiterals& presences);
  // Makes `unless` false if a traversal ends at a time in [begin, end]. Covers presences that are
  // added later.
  void forbid(Time begin, Time end, Literal unless);

 private:
  struct Ban {
    Time begin;
    Time end;
    Literal unless;
  };

  bool is_inner(Place place) const { return corridors_->corridor_of(place) == corridor_; }
  void link(Place before, Place after, Literal from, Literal to, Time arrival);
  Literal inside(Time time);
  Literal ends(Time arrival);

  SatSolver* solver_;
  AgentIndex agent_;
  const Corridors* corridors_;
  int corridor_;
  Place entry_;        // the end at which a traversal enters
  Place first_inner_;  // its first inner place
  Place last_inner_;
  Place exit_;
  std::map<Time, Literal> inside_;  // in a traversal at this time, on an inner place
  std::map<Time, Literal> ends_;    // a traversal ends with an arrival at this time
  std::vector<Ban> bans_;
};

}  // namespace grove::detail
