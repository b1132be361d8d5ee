// SPDX-License-Identifier: MIT
// *Claim: the assignment of a valid plan (path_model.cpp) satisfies the clauses, if rests_by(t) is
// true exactly if the agent rests on the place from time t on or earlier.* *Proof.* Two agents are
// never on one place at the same time. An agent that rests there by time t is there from t on. Of
// two agents, at most one rests on a place. rests_by(t) implies rests_by(u) for u > t.
#include "cores/place_conflicts.h"

#include <algorithm>
#include <iterator>

namespace grove::detail {

void PlaceConflicts::add(AgentIndex agent, const Presence& presence, Literal literal) {
  if (presence.is_last)
    add_rest(agent, presence, literal);
  else
    add_visit(agent, presence, literal);
}

void PlaceConflicts::add_visit(AgentIndex agent, const Presence& presence, Literal literal) {
  Visitors& visitors = visitors_[presence.key()];
  const auto own = std::ranges::find(visitors, agent, &Visitors::value_type::first);
  if (own != visitors.end() || visitors.size() < kMaxAgents) {
    for (const auto& [other, of_other] : visitors)
      if (other != agent) solver_.add({-literal, -of_other});
    if (own != visitors.end())
      own->second = literal;
    else
      visitors.emplace_back(agent, literal);
  }
  OnPlace& place = places_[presence.place];
  for (Resting& resting : place.resting)
    if (resting.agent != agent)
      solver_.add({-rests_by(resting, presence.place, presence.time), -literal});
  place.visits.push_back({agent, presence.time, literal});
}

void PlaceConflicts::add_rest(AgentIndex agent, const Presence& presence, Literal literal) {
  OnPlace& place = places_[presence.place];
  auto known = std::ranges::find(place.resting, agent, &Resting::agent);
  if (known == place.resting.end()) {
    place.resting.push_back({agent, {}});
    known = std::prev(place.resting.end());
    const Literal ever = rests_by(*known, presence.place, kNever);
    for (Resting& other : place.resting)
      if (other.agent != agent) solver_.add({-ever, -rests_by(other, presence.place, kNever)});
    for (const Visit& visit : place.visits)
      if (visit.agent != agent)
        solver_.add({-rests_by(*known, presence.place, visit.time), -visit.literal});
  }
  solver_.add({-literal, rests_by(*known, presence.place, presence.time)});
}

Literal PlaceConflicts::rests_by(Resting& resting, Place place, Time time) {
  const auto [at, is_new] = resting.by.try_emplace(time, 0);
  if (is_new) {
    at->second = solver_.new_variable(FormulaKind::kRests, {resting.agent, place, time});
    if (at != resting.by.begin()) solver_.add({-std::prev(at)->second, at->second});
    if (const auto later = std::next(at); later != resting.by.end())
      solver_.add({-at->second, later->second});
  }
  return at->second;
}

}  // namespace grove::detail
