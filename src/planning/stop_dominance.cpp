// SPDX-License-Identifier: MIT
// Let G be a label that was expanded on stop u, just counted at time g in an interval [.., b] of
// u's cell, coming from state s; and L another label of s. A path P through L counts some stop
// next. If that is u, at a time in [g, b], then G could stand there as well, waiting, in the same
// state after u: from there on P is open to G. L cannot count u before t + dist(L, u). So if that
// is g or later, L is needed for u only in a later interval, which begins at n: such paths cost n +
// onward(u) or more. For each way u on that has no such G the bound is t + dist(L, u) + onward(u).
// The least of all these is what L is postponed to; if there is none, it is dropped. (Ways that the
// graph does not know cost beyond() or more; a label dropped with such a way counts as dropped for
// its state.) Soundness is that of the gates in goals_in_turn.h: when L is postponed beyond
// the optimal cost, an optimal path changes over to a G with fewer stops left, so this ends. With a
// fixed sequence a gate holds for all earlier states; here for one, since the others may count
// other stops on the way to u. The states before are cut off by gates of their own.
//
// Where agents turn, L may count u in another state than G: then G turns, too, which takes it
// so many steps at most, on its place and in its interval. So there the gate of a port stands for
// those that count u by it that much later than g. (At the end of work on u G has all moves of the
// state that it worked in.)
//
// "Later interval" goes by the time of arrival: if u may not be rested on by t and G came by then,
// P comes by t, and then it leaves u again, as G can, or it comes at n = t + 1 or later. And "stand
// there as well" must leave open what P does next: if u has copies, a G in one that is barred from
// leaving the chain makes no gate. One in the free copy does: it can do what the others can.
#include "planning/stop_dominance.h"

#include <algorithm>
#include <cstddef>

namespace grove::detail {

void StopDominance::begin_search() {
  for (const StageId stage : stages_) by_stage_[stage] = kNone;
  stages_.clear();
  gates_.clear();
}

// One gate is kept per way: the one that puts off furthest.
void StopDominance::close(const SequenceStages& goals, StageId from, State state, Time time,
                          Time until) {
  const AgentStops& stops = goals.stops();
  const int stop = stops.stop_at(state);
  const auto ways = goals.onward(goals.stage(from));
  const auto of_stop = [&](const SequenceStages::Onward& way) {
    return way.port / stops.ports() == stop;
  };
  if (std::ranges::none_of(ways, of_stop)) return;
  if (static_cast<std::size_t>(from) >= by_stage_.size())
    by_stage_.resize(2 * static_cast<std::size_t>(from) + 1, kNone);
  if (by_stage_[from] == kNone) {
    stages_.push_back(from);
    gates_.resize(gates_.size() + ways.size());
    by_stage_[from] = static_cast<std::int32_t>(gates_.size() - ways.size());
  }
  for (std::size_t way = 0; way < ways.size(); ++way) {
    if (!of_stop(ways[way])) continue;
    GlobalBounds& gate = gates_[static_cast<std::size_t>(by_stage_[from]) + way];
    const Time there = time + stops.turn(state, ways[way].port);
    if (until > gate.until || (until == gate.until && there < gate.from)) gate = {there, until};
  }
}

Time StopDominance::least_cost(const SequenceStages& goals, StageId stage, State state,
                               Time time) const {
  const GlobalBounds* gate = &gates_[static_cast<std::size_t>(by_stage_[stage])];
  Time least = kNever;
  for (const SequenceStages::Onward& way : goals.onward(goals.stage(stage))) {
    const Time there = time + goals.stops().to_port(state, way.port);
    const Time visit = there >= gate->from ? std::max(there, gate->until) : there;
    if (visit < kNever) least = std::min(least, visit + way.cost);
    ++gate;
  }
  return least;
}

}  // namespace grove::detail
