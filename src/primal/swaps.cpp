// SPDX-License-Identifier: MIT
// *Problem.* In a corridor, priority inheritance only pushes the agent of lower priority ahead, at
// worst into a dead end, although it heads the other way. The remedy is the swap operation of
// LaCAM* (Okumura, IJCAI 2023), after Push and Swap (Luna and Bekris, IJCAI 2011): the agent of
// higher priority moves back to the next junction and pulls the other agent along; at the junction
// one of them can step aside. Two walks along the corridor decide whether to swap. A walk continues
// as long as there is exactly one way on.
//
// *Is a swap needed?* The first walk follows the pusher, which pushes the other agent ahead, as
// long as that brings the pusher nearer to its next stop.
// - If the walk reaches a junction, the other agent can step aside there, so no swap is needed.
// - If the pusher may rest where the walk ends, and the other agent heads for the side from which
//   the pusher comes, they must pass each other (kToPass).
// - If the corridor ends and the pusher still heads there (an agent can have a stop where another
//   agent rests), the other agent must come out first (kDeadEnd).
//
// *Is a swap possible?* The second walk leads backwards. A swap is possible if the walk reaches a
// junction before it returns to its first cell. In both walks a dead end of one cell where an agent
// rests does not count as a way on.
//
// *When an agent backs off.* It backs off for an agent ahead of it that has not chosen yet and so
// has lower priority; for an agent behind it, if they must pass each other; and for an agent behind
// it that heads for the end of the corridor, but only if that agent has already chosen and so has
// higher priority. Without this last condition two agents that both head for the end would let each
// other pass forever.
//
// *Condition.* Swaps are made only in plain worlds (World::is_plain()), in which every step can be
// undone and each place has one state.
#include "primal/swaps.h"

namespace grove::detail {

AgentIndex Swaps::partner(AgentIndex agent, State wish, std::span<const AgentState> from) const {
  const State here = from[agent].state;
  if (!world_.is_plain() || wish == here || !is_possible({wish, here}, from)) return kNoAgent;
  const AgentIndex ahead = now_[wish];
  if (ahead != kNoAgent && to_[ahead] == kNoState &&
      need(agent, ahead, {here, wish}, from) != Need::kNone)
    return ahead;
  for (State cell : world_.neighbors(here)) {
    const AgentIndex behind = now_[cell];
    if (behind == kNoAgent || cell == wish) continue;
    const Need reason = need(behind, agent, {here, wish}, from);
    if (reason == Need::kToPass || (reason == Need::kDeadEnd && to_[behind] != kNoState))
      return behind;
  }
  return kNoAgent;
}

bool Swaps::nearer(AgentIndex agent, std::span<const AgentState> from, State a, State b) const {
  const VisitStages& visits = agents_[agent];
  return visits.distance(from[agent].stage, a) < visits.distance(from[agent].stage, b);
}

Swaps::Need Swaps::need(AgentIndex pusher, AgentIndex pushed, Pair pair,
                        std::span<const AgentState> from) const {
  while (nearer(pusher, from, pair.front, pair.back)) {
    State way = kNoState;
    const int ways = ways_on(pair, from, way);
    if (ways > 1) return Need::kNone;
    if (ways == 0) return Need::kDeadEnd;
    pair = {pair.front, way};
  }
  const bool meet = nearer(pushed, from, pair.back, pair.front) &&
                    agents_[pusher].may_rest(from[pusher].stage, pair.back);
  return meet ? Need::kToPass : Need::kNone;
}

bool Swaps::is_possible(Pair pair, std::span<const AgentState> from) const {
  const State begin = pair.back;
  while (pair.front != begin) {
    State way = kNoState;
    const int ways = ways_on(pair, from, way);
    if (ways != 1) return ways > 1;
    pair = {pair.front, way};
  }
  return false;
}

// True if `cell` is a dead end of one cell where an agent may rest and is.
bool Swaps::is_plugged(State cell, std::span<const AgentState> from) const {
  const AgentIndex there = now_[cell];
  return world_.neighbors(cell).size() == 1 && there != kNoAgent &&
         agents_[there].may_rest(from[there].stage, cell);
}

// Returns the number of ways on from pair.front, and sets `way` to one of them, if there is one.
int Swaps::ways_on(Pair pair, std::span<const AgentState> from, State& way) const {
  int ways = 0;
  for (State cell : world_.neighbors(pair.front)) {
    if (cell == pair.back || is_plugged(cell, from)) continue;
    ++ways;
    way = cell;
  }
  return ways;
}

}  // namespace grove::detail
