// SPDX-License-Identifier: MIT
// An agent is in a traversal from its move from the entry to the first inner place on, as long as
// it stays on inner places; the traversal ends with a move from the last inner place to the exit.
// An agent is at one time on one place, so that the literals for "in a traversal" need only a time.
// The clauses are implications from presences, true for every path: an assignment that has the
// presences of a path and gives each literal of this file its meaning satisfies them.
#include "cores/traversal_clauses.h"

#include "model/assert.h"

namespace grove::detail {

TraversalClauses::TraversalClauses(SatSolver& solver, AgentIndex agent, const Corridors& corridors,
                                   const Constraint& c)
    : solver_(&solver),
      agent_(agent),
      corridors_(&corridors),
      corridor_(corridors.corridor_of(c.from)),
      last_inner_(c.from),
      exit_(c.cell) {
  GROVE_CHECK(c.kind == ConstraintKind::kNoTraversal && corridor_ != Corridors::kNoCorridor,
              "a traversal leaves a corridor");
  const auto places = corridors.places(corridor_);
  const bool leaves_at_back = places.back() == exit_ && places[places.size() - 2] == last_inner_;
  entry_ = leaves_at_back ? places.front() : places.back();
  first_inner_ = leaves_at_back ? places[1] : places[places.size() - 2];
}

void TraversalClauses::add(const Presence& presence, Literal literal,
                           const PresenceLiterals& presences) {
  const auto [place, time, is_last] = presence;
  if (!is_inner(place) && place != entry_ && place != exit_) return;
  if (is_inner(place) && time > 0) solver_->add({-inside(time - 1), -literal, inside(time)});
  const auto with_before = [&](Place before) {
    if (const Literal from = presences.find({before, time - 1, false}))
      link(before, place, from, literal, time);
  };
  if (place == first_inner_) with_before(entry_);
  if (place == exit_) with_before(last_inner_);
  if (is_last) return;
  const auto with_after = [&](Place after) {
    presences.for_each_at(after, time + 1,
                          [&](Literal to) { link(place, after, literal, to, time + 1); });
  };
  if (place == entry_) with_after(first_inner_);
  if (place == last_inner_) with_after(exit_);
}

// Adds the clauses of a move with the presences `from` and `to`.
void TraversalClauses::link(Place before, Place after, Literal from, Literal to, Time arrival) {
  if (before == entry_ && after == first_inner_) solver_->add({-from, -to, inside(arrival)});
  if (before == last_inner_ && after == exit_)
    solver_->add({-from, -to, -inside(arrival - 1), ends(arrival)});
}

void TraversalClauses::forbid(Time begin, Time end, Literal unless) {
  bans_.push_back({begin, end, unless});
  for (auto at = ends_.lower_bound(begin); at != ends_.end() && at->first <= end; ++at)
    solver_->add({-unless, -at->second});
}

Literal TraversalClauses::inside(Time time) {
  Literal& literal = inside_[time];
  if (literal == 0)
    literal = solver_->new_variable(FormulaKind::kInside, {agent_, last_inner_, exit_, time});
  return literal;
}

Literal TraversalClauses::ends(Time arrival) {
  Literal& literal = ends_[arrival];
  if (literal == 0) {
    literal = solver_->new_variable(FormulaKind::kEnds, {agent_, last_inner_, exit_, arrival});
    for (const Ban& ban : bans_)
      if (ban.begin <= arrival && arrival <= ban.end) solver_->add({-ban.unless, -literal});
  }
  return literal;
}

}  // namespace grove::detail
