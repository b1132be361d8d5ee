// SPDX-License-Identifier: MIT
// Dominance between labels at stops (*gates*).
//
// *Rule.* Let G be a label that was expanded on stop u, just counted at time g in an interval [..,
// b] of u's place, coming from stage s. Let L be another label of s. A path P through L counts some
// stop next. If that is u, at a time in [g, b], then G could stand there as well, waiting, in the
// same stage after u: from there on P is open to G. L cannot count u before t + dist(L, u). So if
// that is g or later, L is needed for u only in a later interval, which begins at n; such paths
// cost n + onward(u) or more. For each onward stop u that has no such G the bound is t + dist(L, u)
// + onward(u). L is postponed to the least of these bounds; if there is none, it is dropped.
// (Onward stops that the graph does not cover cost outside_bound() or more. A label dropped with
// such a stop counts as dropped for its stage.)
//
// *Soundness* is that of the gates in fixed_order_goals.h: if L is postponed beyond the optimal
// cost, an optimal path changes over to a G with fewer stops left, so this ends. With a fixed
// sequence a gate holds for all earlier stages. Here it holds for one stage, because earlier stages
// may count other stops on the way to u. The earlier stages are cut off by gates of their own.
//
// *Turning agents.* If agents turn, L may count u in another state than G. Then G turns, too, on
// its place and in its interval, for a bounded number of steps. So the gate of a port dominates
// those labels that count u by this port at least that many steps later than g. (At the end of work
// on u, G has all moves of the state that it worked in.)
//
// *Later interval* refers to the time of arrival. If u may not be rested on by t and G arrived by
// then: if P arrives by t, it leaves u again, as G can; otherwise it arrives at n = t + 1 or later.
//
// *Stand there as well* must leave open what P does next. If u has copies, a G in a copy that is
// barred from leaving the corridor makes no gate. A G in the free copy makes one, because it can do
// everything that the others can.
#include "planning/stop_dominance.h"

#include <algorithm>
#include <cstddef>

namespace grove::detail {

void StopDominance::begin_search() {
  for (const StageId stage : stages_) by_stage_[stage] = kNone;
  stages_.clear();
  gates_.clear();
}

// Keeps one gate per onward port: the one that postpones furthest.
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
    Gate& gate = gates_[static_cast<std::size_t>(by_stage_[from]) + way];
    const Time there = time + stops.turn(state, ways[way].port);
    if (until > gate.until || (until == gate.until && there < gate.from)) gate = {there, until};
  }
}

Time StopDominance::min_cost(const SequenceStages& goals, StageId stage, State state,
                             Time time) const {
  const Gate* gate = &gates_[static_cast<std::size_t>(by_stage_[stage])];
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
