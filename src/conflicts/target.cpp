// SPDX-License-Identifier: MIT
// Target reasoning (Li, Harabor, Stuckey, Ma, Gange and Koenig, AIJ 2021), without its labels.
//
// Agent a is on place v from time f on for ever, and b passes v at t >= f. The standard split bars
// a from v at t, which makes it come later or step aside and back, or b; and the same again for t +
// 1, for t + 2, ... Splitting on the fact that matters settles all of them at once:
//
//   kNoRestBy: a does not come to v for good at t or earlier;
//   kRestBy:   a comes to v for good at t or earlier. Then a is on v at every time from t on, so no
//              other agent is: they all are barred from v from t on.
//
// *No plan is lost*: the two are each other's negation, whatever the agents' orders of visits and
// whether a has a destination or may end on any of its tasks. *Both children differ from the
// parent*: a's path breaks the first, b's what follows from the second.
#include "conflicts/symmetry_reasoning.h"

namespace grove::detail {

std::optional<Split> target_split(const Conflict& conflict, std::span<const Path> paths,
                                  const World& world, const Corridors& /*chains*/) {
  if (conflict.is_swap() || conflict.is_following()) return std::nullopt;
  const auto rests = [&](AgentIndex agent) {
    return last_arrival(world, paths[agent]) <= conflict.time;
  };
  const AgentIndex agent = rests(conflict.first)    ? conflict.first
                           : rests(conflict.second) ? conflict.second
                                                    : -1;
  if (agent < 0) return std::nullopt;
  const auto demand = [&](ConstraintKind kind) {
    return AgentConstraint{agent, {conflict.cell, kNoPlace, 0, conflict.time, kind}};
  };
  return Split{demand(ConstraintKind::kNoRestBy), demand(ConstraintKind::kRestBy)};
}

}  // namespace grove::detail
