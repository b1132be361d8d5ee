// SPDX-License-Identifier: MIT
// *Problem.* In a corridor, priority inheritance only pushes the agent of lower priority ahead, at
// worst into a dead end, although it heads the other way. The remedy is the swap of LaCAM*
// (Okumura, IJCAI 2023), after Push and Swap (Luna and Bekris, IJCAI 2011): the agent of higher
// priority backs off to the next junction and pulls the other along; there one of them can step
// aside. Two walks along cells with one way on decide whether to swap.
//
// *Is a swap needed?* The pusher pushes the other agent ahead as long as that brings the pusher
// nearer to its next stop.
// - At a junction the other can step aside: no swap.
// - If the pusher may rest where the walk ends, and the other heads for where the pusher comes
//   from, they must pass.
// - If the corridor ends and the pusher still heads there (an agent may have its stops where
//   another one rests), the other must come out first.
//
// *Is a swap possible?* Yes if the two, pulled backwards, reach a junction before they return to
// their starting cell. In both walks a dead end of one cell where an agent rests does not count as
// a way on.
//
// *When an agent backs off.* For an agent ahead of it that has not chosen yet, so has lower
// priority; for an agent behind it that must pass; and for an agent behind it that heads for the
// end of the corridor, only if that agent has chosen, so has higher priority. Otherwise two agents
// that both head there would let each other pass for ever.
//
// *Condition.* Every step can be undone, and a state is its place: only in plain worlds
// (World::is_plain()).
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
    if (reason == Need::kToPass || (reason == Need::kToGetAtEnd && to_[behind] != kNoState))
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
    if (ways == 0) return Need::kToGetAtEnd;
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

// Is this a dead end of one cell where an agent rests?
bool Swaps::is_plugged(State cell, std::span<const AgentState> from) const {
  const AgentIndex there = now_[cell];
  return world_.neighbors(cell).size() == 1 && there != kNoAgent &&
         agents_[there].may_rest(from[there].stage, cell);
}

// The number of ways on from the front; `way` becomes one of them.
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
