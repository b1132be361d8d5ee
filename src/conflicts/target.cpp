// SPDX-License-Identifier: MIT
// Target reasoning (Li, Harabor, Stuckey, Ma, Gange and Koenig, AIJ 2021), without the labels used
// there, for agents with several goals.
//
// *Problem.* Agent a stays on place v forever from time f on, and b passes v at t >= f. The
// standard split bars a from v at t, so that a arrives later or steps aside and returns, or it bars
// b from v at t. The same conflict then occurs at t + 1, t + 2, ... The following split resolves
// all of these conflicts at once:
//
//   kNoRestBy: a does not arrive at v for good at t or earlier;
//   kRestBy:   a arrives at v for good at t or earlier. Then a is on v at every time from t on, so
//              no other agent is: all others are barred from v from t on.
//
// *Claim: no plan is lost.* The two constraints are each other's negation, whatever the agents'
// orders of visits, and whether a has a destination or may end on any of its tasks. *Claim: both
// children differ from the parent.* The path of a violates the first constraint, and the path of b
// violates the constraint on b that follows from the second.
#include "conflicts/symmetry_reasoning.h"
#include "model/assert.h"
#include "planning/constraint.h"

namespace grove::detail {

std::optional<Split> target_split(const Conflict& conflict, std::span<const Path> paths,
                                  const World& world, const Corridors& corridors) {
  if (conflict.is_swap() || conflict.is_following()) return std::nullopt;
  const auto rests = [&](AgentIndex agent) {
    return last_arrival(world, paths[agent]) <= conflict.time;
  };
  const AgentIndex agent = rests(conflict.first)    ? conflict.first
                           : rests(conflict.second) ? conflict.second
                                                    : -1;
  if (agent < 0) return std::nullopt;
  const auto constraint = [&](ConstraintKind kind) {
    return AgentConstraint{agent, {conflict.cell, kNoPlace, 0, conflict.time, kind}};
  };
  const Split split{constraint(ConstraintKind::kNoRestBy), constraint(ConstraintKind::kRestBy)};
  const AgentIndex other = agent == conflict.first ? conflict.second : conflict.first;
  GROVE_ASSERT(!satisfies(world, paths[agent], split[0].constraint, corridors),
               "the path of the resting agent violates the first side of a target split");
  GROVE_ASSERT(!satisfies(world, paths[other], *constraint_on(other, split[1]), corridors),
               "the path of the passing agent violates the second side of a target split");
  return split;
}

}  // namespace grove::detail
