// SPDX-License-Identifier: MIT
// Priority inheritance alone pushes the weaker of two agents ahead through a corridor, into a dead
// end at worst, though that one wants to go the other way. The remedy is that of LaCAM* (Okumura,
// IJCAI 2023), after Push and Swap (Luna and Bekris, IJCAI 2011): the stronger one backs off to the
// next junction and pulls the other along; there one can step aside. To see whether, two walks
// along cells with one way on:
//
// Needed: the pusher pushes the other before it as long as that takes it nearer to its next stop.
// At a junction the other can step aside: no need. Where the pusher comes to rest, the other may
// want to get out behind it: they have to pass. And if the way ends, with the pusher still wanting
// to go there (others have their stops where somebody rests), the other must come out first.
//
// Possible: pulled backwards, they come to a junction before they come round to where they were.
//
// A dead end of one cell where somebody rests makes no junction.
//
// An agent backs off for one ahead of it that has not chosen yet, so is weaker; for one behind that
// has to pass; and for one behind that wants to get to the end of the way only if that one has
// chosen, so is stronger: else two that both want to go there would let each other pass for ever.
//
// All of this takes it that every step can be undone and that a state is its place: only in plain
// worlds.
#include "primal/swaps.h"

namespace grove::detail {

AgentIndex Swaps::partner(AgentIndex agent, State wish, std::span<const Standing> from) const {
  const State here = from[agent].state;
  if (!world_.is_plain() || wish == here || !is_possible({wish, here}, from)) return kNobody;
  const AgentIndex ahead = now_[wish];
  if (ahead != kNobody && to_[ahead] == kNoState &&
      need(agent, ahead, {here, wish}, from) != Need::kNone)
    return ahead;
  for (State cell : world_.neighbors(here)) {
    const AgentIndex behind = now_[cell];
    if (behind == kNobody || cell == wish) continue;
    const Need reason = need(behind, agent, {here, wish}, from);
    if (reason == Need::kToPass || (reason == Need::kToGetAtEnd && to_[behind] != kNoState))
      return behind;
  }
  return kNobody;
}

bool Swaps::nearer(AgentIndex agent, std::span<const Standing> from, State a, State b) const {
  const VisitStages& visits = agents_[agent];
  return visits.distance(from[agent].stage, a) < visits.distance(from[agent].stage, b);
}

Swaps::Need Swaps::need(AgentIndex pusher, AgentIndex pushed, Pair pair,
                        std::span<const Standing> from) const {
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

bool Swaps::is_possible(Pair pair, std::span<const Standing> from) const {
  const State begin = pair.back;
  while (pair.front != begin) {
    State way = kNoState;
    const int ways = ways_on(pair, from, way);
    if (ways != 1) return ways > 1;
    pair = {pair.front, way};
  }
  return false;
}

// Is this a dead end of one cell where somebody rests?
bool Swaps::is_plugged(State cell, std::span<const Standing> from) const {
  const AgentIndex there = now_[cell];
  return world_.neighbors(cell).size() == 1 && there != kNobody &&
         agents_[there].may_rest(from[there].stage, cell);
}

// How many ways lead on from the front, and one of them.
int Swaps::ways_on(Pair pair, std::span<const Standing> from, State& way) const {
  int ways = 0;
  for (State cell : world_.neighbors(pair.front)) {
    if (cell == pair.back || is_plugged(cell, from)) continue;
    ++ways;
    way = cell;
  }
  return ways;
}

}  // namespace grove::detail
